//! Title, colour bars and axes.

use super::super::colour::engineering;
use super::canvas::Canvas;
use super::ramp::Ramp;
use super::scene::Scene;
use super::view::View;
use plotters::coord::Shift;
use plotters::prelude::*;
use plotters::style::text_anchor::{HPos, Pos, VPos};

/// DejaVu Sans, so that pictures do not depend on the machine's fonts.
static FONT: &[u8] = include_bytes!("../../../assets/DejaVuSans-subset.ttf");

/// The name under which [`FONT`] is known to plotters.
const FAMILY: &str = "seawall";

const INK: RGBColor = RGBColor(38, 44, 54);
const FAINT_INK: RGBColor = RGBColor(120, 128, 140);

/// What is written on and around the scene. Lengths are in pixels of the picture.
pub struct Annotation<'a> {
    /// Name of the case.
    pub title: String,
    /// Simulated time (s).
    pub time: f64,
    /// What is shown.
    pub scene: &'a Scene,
    /// From where.
    pub view: &'a View,
    /// Canvas pixels per pixel of the picture.
    pub pixel: f64,
}

type Area<'a> = DrawingArea<BitMapBackend<'a>, Shift>;

impl Annotation<'_> {
    /// Writes on `canvas`.
    ///
    /// # Errors
    /// The reason in words when the font cannot be used.
    pub fn draw(&self, canvas: &mut Canvas) -> Result<(), String> {
        plotters::style::register_font(FAMILY, FontStyle::Normal, FONT)
            .map_err(|_| "the built-in font is damaged".to_owned())?;
        let size = (canvas.width as u32, canvas.height as u32);
        let area = BitMapBackend::with_buffer(&mut canvas.pixels, size).into_drawing_area();
        let width = f64::from(size.0) / self.pixel;
        self.title(&area)?;
        let ramps = [&self.scene.water_ramp, &self.scene.solid_ramp];
        for (i, ramp) in ramps.into_iter().flatten().rev().enumerate() {
            self.colour_bar(&area, ramp, width - 48.0 - 260.0 - 330.0 * i as f64)?;
        }
        self.axes(&area)?;
        area.present().map_err(|error| error.to_string())
    }

    fn title(&self, area: &Area) -> Result<(), String> {
        let title = format!("{},  t = {:.3} s", self.title, self.time);
        self.text(area, &title, [28.0, 22.0], 30.0, (HPos::Left, VPos::Top))
    }

    fn colour_bar(&self, area: &Area, ramp: &Ramp, left: f64) -> Result<(), String> {
        const LENGTH: f64 = 260.0;
        let (top, bottom) = (44.0, 60.0);
        self.text(area, ramp.quantity, [left, 18.0], 19.0, (HPos::Left, VPos::Top))?;
        let columns = (LENGTH * self.pixel) as usize;
        for column in 0..columns {
            let [r, g, b] = ramp.at((column as f64 + 0.5) / columns as f64);
            let x = (left * self.pixel) as i32 + column as i32;
            let line = [(x, self.whole(top)), (x, self.whole(bottom))];
            self.line(area, &line, RGBColor(r, g, b), 1)?;
        }
        let shares: &[f64] = if ramp.upper > 0.0 { &[0.0, 0.5, 1.0] } else { &[0.0] };
        for &share in shares {
            let x = left + share * LENGTH;
            let tick =
                [(self.whole(x), self.whole(bottom)), (self.whole(x), self.whole(bottom + 4.0))];
            self.line(area, &tick, FAINT_INK, self.pixel as u32)?;
            let value = engineering(share * ramp.upper, ramp.unit);
            self.text(area, &value, [x, bottom + 7.0], 17.0, (HPos::Center, VPos::Top))?;
        }
        Ok(())
    }

    /// Along the lower front edge, the left edge and, in space, the lower left edge: none of
    /// them can be hidden.
    fn axes(&self, area: &Area) -> Result<(), String> {
        let (low, high) = self.scene.frame();
        let mut axes = vec![Axis { name: "x", along: 0, from: low, side: Side::Below }];
        if self.scene.dimension() == 2 {
            axes.push(Axis { name: "y", along: 1, from: low, side: Side::Left });
        } else {
            axes.push(Axis { name: "y", along: 1, from: low, side: Side::Corner });
            let back = [low[0], high[1], low[2]];
            axes.push(Axis { name: "z", along: 2, from: back, side: Side::Left });
        }
        axes.iter().try_for_each(|axis| self.axis(area, axis, high[axis.along]))
    }

    fn axis(&self, area: &Area, axis: &Axis, end: f64) -> Result<(), String> {
        let at = |value: f64, aside: f64| {
            let mut point = axis.from;
            point[axis.along] = value;
            let [column, row, _] = self.view.project(point);
            let [right, down] = axis.side.outward();
            [column / self.pixel + aside * right, row / self.pixel + aside * down]
        };
        let stroke = |a: [f64; 2], b: [f64; 2]| {
            let points = [a, b].map(|[x, y]| (self.whole(x), self.whole(y)));
            self.line(area, &points, FAINT_INK, self.pixel as u32)
        };
        let start = axis.from[axis.along];
        let (first, last) = (at(start, 0.0), at(end, 0.0));
        stroke(first, last)?;
        let length = (last[0] - first[0]).hypot(last[1] - first[1]);
        for tick in ticks(start, end, length) {
            let foot = at(tick.value, 0.0);
            // Another axis starts there with its own number.
            if axis.side == Side::Corner && (last[1] - foot[1]).abs() < 14.0 {
                continue;
            }
            stroke(foot, at(tick.value, 5.0))?;
            self.text(area, &tick.label, at(tick.value, 9.0), 17.0, axis.side.anchor())?;
        }
        let middle = at(0.5 * (start + end), 34.0);
        let (place, anchor) = match axis.side {
            Side::Below => (middle, axis.side.anchor()),
            // Below the numbers, where there is room for it.
            Side::Corner => ([middle[0], middle[1] + 18.0], axis.side.anchor()),
            // Beside the axis it would have to dodge numbers of any length.
            Side::Left => ([last[0], last[1] - 12.0], (HPos::Center, VPos::Bottom)),
        };
        self.text(area, &format!("{} (m)", axis.name), place, 19.0, anchor)
    }

    fn text(
        &self,
        area: &Area,
        text: &str,
        [x, y]: [f64; 2],
        size: f64,
        (horizontal, vertical): (HPos, VPos),
    ) -> Result<(), String> {
        let style = (FAMILY, size * self.pixel)
            .into_text_style(area)
            .color(&INK)
            .pos(Pos::new(horizontal, vertical));
        area.draw_text(text, &style, (self.whole(x), self.whole(y)))
            .map_err(|error| error.to_string())
    }

    fn line(
        &self,
        area: &Area,
        points: &[(i32, i32)],
        colour: RGBColor,
        width: u32,
    ) -> Result<(), String> {
        let path = PathElement::new(points.to_vec(), colour.stroke_width(width));
        area.draw(&path).map_err(|error| error.to_string())
    }

    fn whole(&self, length: f64) -> i32 {
        (length * self.pixel).round() as i32
    }
}

/// An axis that starts at the point `from` and has its numbers on one side.
struct Axis {
    name: &'static str,
    along: usize,
    from: [f64; 3],
    side: Side,
}

/// Where an axis has its numbers.
#[derive(Clone, Copy, PartialEq, Eq)]
enum Side {
    /// A lower edge, numbers below.
    Below,
    /// An upright edge, numbers on the left.
    Left,
    /// The edge between the two, numbers on the left.
    Corner,
}

impl Side {
    /// To the right and down.
    fn outward(self) -> [f64; 2] {
        match self {
            Self::Below => [0.0, 1.0],
            Self::Left | Self::Corner => [-1.0, 0.0],
        }
    }

    /// The part of a number that is nearest to the axis.
    fn anchor(self) -> (HPos, VPos) {
        match self {
            Self::Below => (HPos::Center, VPos::Top),
            Self::Left | Self::Corner => (HPos::Right, VPos::Center),
        }
    }
}

struct Tick {
    value: f64,
    label: String,
}

/// Multiples of 1, 2 or 5 times a power of ten, at least 55 pixels apart where
/// that leaves two of them.
fn ticks(start: f64, end: f64, pixels: f64) -> Vec<Tick> {
    const APART: f64 = 55.0;
    let range = end - start;
    if range.is_nan() || range <= 0.0 {
        return Vec::new();
    }
    let smallest = (range * APART / pixels).min(range);
    let power = 10f64.powf(smallest.log10().floor());
    let factor = [1.0, 2.0, 5.0].into_iter().find(|f| f * power >= smallest * (1.0 - 1e-9));
    let step = factor.unwrap_or(10.0) * power;
    let decimals = (-step.log10().floor()).max(0.0) as usize;
    let slack = 1e-6 * step;
    let (from, to) =
        (((start - slack) / step).ceil() as i64, ((end + slack) / step).floor() as i64);
    (from..=to)
        .map(|n| n as f64 * step)
        .map(|value| Tick { value, label: format!("{value:.decimals$}") })
        .collect()
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn ticks_are_round_numbers_inside_the_axis() {
        let labels = |start, end, pixels| -> Vec<String> {
            ticks(start, end, pixels).into_iter().map(|tick| tick.label).collect()
        };
        assert_eq!(labels(-0.1, 2.0, 250.0), ["0.0", "0.5", "1.0", "1.5", "2.0"]);
        assert_eq!(labels(0.0, 16.0, 1200.0).len(), 17);
        assert_eq!(labels(0.0, 1.0, 20.0), ["0", "1"]);
        assert!(labels(1.0, 1.0, 100.0).is_empty());
    }
}
