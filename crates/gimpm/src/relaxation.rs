//! The static state: the balance of forces tells when it is reached.

use nalgebra::SVector;

use crate::field::Field;
use crate::solid::Solid;

impl<const D: usize> Solid<D> {
    /// Sum of all forces on the solid in the last step, over the larger of its
    /// loads and its reactions (G28): 0 in equilibrium, 1 in free fall; 0 as long as
    /// nothing acts.
    pub fn out_of_balance(&self) -> f64 {
        let reactions = &self.state.reactions;
        let held: SVector<f64, D> = reactions.iter().map(|reaction| reaction.force).sum();
        let holding: f64 = reactions.iter().map(|reaction| reaction.force.norm()).sum();
        let load = self.state.load + self.state.point_load;
        let scale = load.norm().max(holding);
        if scale > 0.0 { (held + load).norm() / scale } else { 0.0 }
    }

    /// `Σ_v ½ m_v v_v²` with the velocity that strained the points last (J). The points'
    /// own kinetic energy never dies with FLIP: the grid neither sees nor damps what
    /// cancels out between neighbours.
    fn grid_kinetic_energy(&self) -> f64 {
        let of_field = |field: &Field<D>| {
            let (nodes, velocity) = (&field.grid.nodes, &field.grid.remapped);
            let [kinetic] = ordered_reduction::sum(nodes.len(), |v| {
                let square: f64 = (0..D).map(|d| velocity[v][d].powi(2)).sum();
                [0.5 * nodes[v][0] * square]
            });
            kinetic
        };
        self.fields.iter().map(of_field).sum()
    }

    /// Whether the static state is reached: all ramps are over, the forces are
    /// balanced to the tolerance ε of [`Relaxation`](crate::Relaxation), and the
    /// kinetic energy of the grid is below ε of the elastic one. (The balance alone is also
    /// met in passing, where the kinetic energy is largest.)
    pub fn is_relaxed(&self) -> bool {
        let Some(relaxation) = self.parameters.relaxation else { return false };
        let ramps = self.surfaces.iter().map(|surface| surface.ramp());
        let ramp = ramps.fold(self.parameters.gravity_ramp, f64::max);
        if self.state.steps == 0
            || self.state.time <= ramp
            || self.out_of_balance() > relaxation.tolerance
        {
            return false;
        }
        let strain = self.energy().strain;
        strain > 0.0 && self.grid_kinetic_energy() <= relaxation.tolerance * strain
    }
}
