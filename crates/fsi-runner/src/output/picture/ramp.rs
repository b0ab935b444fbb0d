//! Colour scales of pictures. Each starts at its material's own colour and gets
//! steadily lighter or darker, so that water and solid cannot be confused and the
//! order survives printing in grey.

use super::super::colour::{ColourScale, Rgb, high_percentile};

/// Evenly spaced colours from 0 to the upper end.
type Stops = [Rgb; 6];

/// Deep water to foam.
const WATER: Stops = [
    [14, 62, 128],
    [24, 103, 178],
    [42, 150, 210],
    [90, 196, 220],
    [166, 226, 229],
    [240, 250, 246],
];

/// Concrete to glowing red.
const SOLID: Stops =
    [[203, 197, 188], [240, 205, 140], [250, 160, 80], [232, 92, 48], [185, 28, 36], [110, 5, 32]];

/// What a colour says about a quantity.
#[derive(Clone, Debug, PartialEq)]
pub struct Ramp {
    /// The quantity, in words.
    pub quantity: &'static str,
    /// Its SI unit.
    pub unit: &'static str,
    /// The value of the last colour; 0 where the quantity is 0 everywhere.
    pub upper: f64,
    stops: Stops,
}

impl Ramp {
    /// Speed of water, covering all but a few of `values` (m/s).
    pub fn speed(values: &[f64]) -> Self {
        Self { quantity: "speed of the water", unit: "m/s", upper: upper(values), stops: WATER }
    }

    /// Von Mises stress of solids, covering all but a few of `values` (Pa).
    pub fn von_mises(values: &[f64]) -> Self {
        Self { quantity: "von Mises stress", unit: "Pa", upper: upper(values), stops: SOLID }
    }

    /// The colour of `value`.
    pub fn colour(&self, value: f64) -> Rgb {
        self.at(if self.upper > 0.0 { value / self.upper } else { 0.0 })
    }

    /// The colour at `share` of the way from 0 to the upper end.
    pub fn at(&self, share: f64) -> Rgb {
        let share = if share.is_nan() { 0.0 } else { share.clamp(0.0, 1.0) };
        let place = share * (self.stops.len() - 1) as f64;
        let left = (place as usize).min(self.stops.len() - 2);
        let right = place - left as f64;
        std::array::from_fn(|i| {
            let [a, b] = [self.stops[left][i], self.stops[left + 1][i]].map(f64::from);
            (a + (b - a) * right).round() as u8
        })
    }
}

fn upper(values: &[f64]) -> f64 {
    ColourScale::covering(high_percentile(values)).upper
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn the_ends_and_what_lies_outside() {
        let ramp = Ramp::speed(&[4.0]);
        assert_eq!(ramp.colour(0.0), WATER[0]);
        assert_eq!(ramp.colour(-1.0), WATER[0]);
        assert_eq!(ramp.colour(1e9), WATER[5]);
        assert_eq!(Ramp::von_mises(&[]).colour(3.0), SOLID[0]);
    }
}
