//! What every constitutive law must satisfy, as one macro.

/// Defines a function `$name` that checks a [`Material`](crate::Material):
/// constants valid; no strain, no stress change; energy zero without stress,
/// positive with it, and equal to the work done on a closed path from zero
/// (`dψ = σ:dε` for small strains); wave speed equal to the slope of the stress
/// in confined compression. Write `#[test]` before the name in a test module.
#[macro_export]
macro_rules! material_conformance {
    ($(#[$attribute:meta])* $name:ident, $material:expr) => {
        $(#[$attribute])*
        fn $name() {
            use $crate::Material as _;
            let material = $material;
            assert!(material.validate().is_ok());
            let zero = [0.0; 6];
            assert_eq!(material.update_stress(zero, &zero), zero, "no strain, no stress");
            assert_eq!(material.strain_energy_density(&zero), 0.0);
            let direction = [3.0e-7, -5.0e-7, 1.0e-7, 2.0e-7, -1.0e-7, 4.0e-7];
            let (mut stress, mut work) = (zero, 0.0);
            for _ in 0..100 {
                let next = material.update_stress(stress, &direction);
                for k in 0..6 {
                    let weight = if k < 3 { 0.5 } else { 1.0 };
                    work += weight * (stress[k] + next[k]) * direction[k];
                }
                stress = next;
            }
            let energy = material.strain_energy_density(&stress);
            assert!(energy > 0.0);
            assert!((energy / work - 1.0).abs() < 1e-6, "energy {energy}, work {work}");
            let axial = [1.0e-8, 0.0, 0.0, 0.0, 0.0, 0.0];
            let modulus = material.update_stress(zero, &axial)[0] / axial[0];
            let wave = (modulus / material.density()).sqrt();
            assert!((material.p_wave_speed() / wave - 1.0).abs() < 1e-6);
        }
    };
}
