//! A grid of pixels with depth, and what can be painted on it.

use super::super::colour::Rgb;
use std::io::Write;

/// Pixels, row after row from the top.
pub struct Canvas {
    /// Columns.
    pub width: usize,
    /// Rows.
    pub height: usize,
    /// Red, green and blue of each pixel.
    pub pixels: Vec<u8>,
    /// Nearness of what each pixel shows.
    nearness: Vec<f32>,
}

/// How bright a part of a surface is that faces `normal` (right, up, towards the
/// viewer): the light comes over the viewer's left shoulder.
pub fn brightness(normal: [f64; 3]) -> f64 {
    const LIGHT: [f64; 3] = [-0.35, 0.72, 0.6];
    let along: f64 = (0..3).map(|i| LIGHT[i] * normal[i]).sum();
    0.62 + 0.38 * along.max(0.0)
}

impl Canvas {
    /// A white canvas.
    pub fn new(width: usize, height: usize) -> Self {
        Self {
            width,
            height,
            pixels: vec![255; 3 * width * height],
            nearness: vec![f32::NEG_INFINITY; width * height],
        }
    }

    /// A filled circle: `centre` is column, row and nearness.
    pub fn circle(&mut self, centre: [f64; 3], radius: f64, colour: Rgb) {
        self.disc(centre, radius, |canvas, at, _| canvas.set(at, centre[2], colour));
    }

    /// A lit ball: `centre` is column, row and nearness.
    pub fn ball(&mut self, centre: [f64; 3], radius: f64, colour: Rgb) {
        self.disc(centre, radius, |canvas, at, normal| {
            canvas.set(at, centre[2] + radius * normal[2], shaded(colour, brightness(normal)));
        });
    }

    /// A triangle of one colour; corners are column, row and nearness.
    pub fn triangle(&mut self, corners: [[f64; 3]; 3], colour: Rgb) {
        let [a, b, c] = corners;
        let area = (b[0] - a[0]) * (c[1] - a[1]) - (b[1] - a[1]) * (c[0] - a[0]);
        if area == 0.0 {
            return;
        }
        let (columns, rows) = (self.range(0, &corners), self.range(1, &corners));
        for row in rows {
            for column in columns.clone() {
                let [x, y] = [column, row].map(|n| n as f64 + 0.5);
                let v = ((x - a[0]) * (c[1] - a[1]) - (y - a[1]) * (c[0] - a[0])) / area;
                let w = ((b[0] - a[0]) * (y - a[1]) - (b[1] - a[1]) * (x - a[0])) / area;
                if v >= 0.0 && w >= 0.0 && v + w <= 1.0 {
                    let nearness = a[2] + v * (b[2] - a[2]) + w * (c[2] - a[2]);
                    self.set(row * self.width + column, nearness, colour);
                }
            }
        }
    }

    /// Calls `paint` with each pixel of a disc and the normal of a ball there.
    fn disc(
        &mut self,
        [x, y, _]: [f64; 3],
        radius: f64,
        paint: impl Fn(&mut Self, usize, [f64; 3]),
    ) {
        let ends = [[x - radius, y - radius, 0.0], [x + radius, y + radius, 0.0]];
        let (columns, rows) = (self.range(0, &ends), self.range(1, &ends));
        for row in rows {
            for column in columns.clone() {
                let right = (column as f64 + 0.5 - x) / radius;
                let up = (y - row as f64 - 0.5) / radius;
                let rest = 1.0 - right * right - up * up;
                if rest >= 0.0 {
                    paint(self, row * self.width + column, [right, up, rest.sqrt()]);
                }
            }
        }
    }

    /// The columns (axis 0) or rows (axis 1) that `points` span, within the canvas.
    fn range(&self, axis: usize, points: &[[f64; 3]]) -> std::ops::Range<usize> {
        let limit = if axis == 0 { self.width } else { self.height };
        let low = points.iter().map(|p| p[axis]).fold(f64::INFINITY, f64::min);
        let high = points.iter().map(|p| p[axis]).fold(f64::NEG_INFINITY, f64::max);
        // A float turns into the nearest number that fits; NaN into 0.
        (low.floor() as usize).min(limit)..(high.ceil() as usize).min(limit)
    }

    fn set(&mut self, at: usize, nearness: f64, colour: Rgb) {
        if nearness as f32 >= self.nearness[at] {
            self.nearness[at] = nearness as f32;
            self.pixels[3 * at..3 * at + 3].copy_from_slice(&colour);
        }
    }

    /// Every `factor` x `factor` pixels averaged into one.
    pub fn shrunk(&self, factor: usize) -> Self {
        let mut small = Self::new(self.width / factor, self.height / factor);
        for row in 0..small.height {
            for column in 0..small.width {
                for channel in 0..3 {
                    let sum: usize = (0..factor * factor)
                        .map(|n| (row * factor + n / factor, column * factor + n % factor))
                        .map(|(y, x)| usize::from(self.pixels[3 * (y * self.width + x) + channel]))
                        .sum();
                    let mean = (sum + factor * factor / 2) / (factor * factor);
                    small.pixels[3 * (row * small.width + column) + channel] = mean as u8;
                }
            }
        }
        small
    }

    /// Writes the pixels as PNG.
    pub fn write(&self, to: impl Write) -> Result<(), png::EncodingError> {
        let mut encoder = png::Encoder::new(to, self.width as u32, self.height as u32);
        encoder.set_color(png::ColorType::Rgb);
        encoder.set_depth(png::BitDepth::Eight);
        encoder.set_compression(png::Compression::High);
        let mut writer = encoder.write_header()?;
        writer.write_image_data(&self.pixels)?;
        writer.finish()
    }
}

/// `colour` made darker.
pub fn shaded(colour: Rgb, brightness: f64) -> Rgb {
    colour.map(|channel| (f64::from(channel) * brightness).round().clamp(0.0, 255.0) as u8)
}

#[cfg(test)]
mod tests {
    use super::*;

    const RED: Rgb = [255, 0, 0];
    const BLUE: Rgb = [0, 0, 255];

    fn count(canvas: &Canvas, colour: Rgb) -> usize {
        canvas.pixels.as_chunks::<3>().0.iter().filter(|&&pixel| pixel == colour).count()
    }

    #[test]
    fn the_nearer_one_is_seen_whatever_the_order() {
        for order in [[RED, BLUE], [BLUE, RED]] {
            let mut canvas = Canvas::new(40, 40);
            for colour in order {
                canvas.circle([20.0, 20.0, if colour == RED { 1.0 } else { 0.0 }], 10.0, colour);
            }
            assert_eq!(count(&canvas, BLUE), 0);
            let area = std::f64::consts::PI * 100.0;
            assert!((count(&canvas, RED) as f64 - area).abs() < 0.03 * area);
        }
    }

    #[test]
    fn two_triangles_fill_a_square_and_what_is_outside_is_cut_off() {
        let mut canvas = Canvas::new(10, 10);
        let [a, b, c, d] = [[2.0, 2.0, 0.0], [50.0, 2.0, 0.0], [50.0, 50.0, 0.0], [2.0, 50.0, 0.0]];
        canvas.triangle([a, b, c], RED);
        canvas.triangle([a, d, c], RED);
        canvas.circle([-30.0, f64::NAN, 0.0], 5.0, BLUE);
        assert_eq!(count(&canvas, RED), 64);
        assert_eq!(count(&canvas, BLUE), 0);
    }

    #[test]
    fn shrinking_averages() {
        let mut canvas = Canvas::new(4, 2);
        canvas.pixels[..3].copy_from_slice(&[0, 255, 55]);
        let small = canvas.shrunk(2);
        assert_eq!((small.width, small.height), (2, 1));
        assert_eq!(small.pixels, [191, 255, 205, 255, 255, 255]);
    }
}
