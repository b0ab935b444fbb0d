//! One frame of a run as a PNG: water coloured by its speed, solids by their von
//! Mises stress, rigid walls in grey, with axes in metres.
//!
//! Everything is drawn at twice the size and averaged down, which smooths edges,
//! lines and text alike.

mod annotation;
mod canvas;
mod ramp;
mod scene;
mod view;

use super::error::{At, OutputError};
use super::replace_file::{Durability, replace_file_with};
use super::run_reader::{FrameInfo, RunReader};
use canvas::Canvas;
use scene::Scene;
use std::path::Path;
use view::View;

/// Width of the picture (pixels). The height follows the scene.
pub const WIDTH: usize = 1400;

/// Smallest and largest height of the picture (pixels).
pub const HEIGHTS: (usize, usize) = (420, 1000);

/// Pixels drawn for each side of a pixel written.
const SUPERSAMPLING: usize = 2;

/// Room for title, colour bars and axes (pixels).
const MARGIN: Margin = Margin { left: 76.0, right: 60.0, top: 112.0, bottom: 66.0 };

/// Room around the scene.
struct Margin {
    left: f64,
    right: f64,
    top: f64,
    bottom: f64,
}

/// Draws frame `frame` (the last by default) to the PNG file `out`.
///
/// Two dimensions are drawn in their plane; three in parallel projection from the
/// front (−y), a little from the left (−x) and above.
///
/// # Errors
/// [`OutputError::InvalidData`] naming the number of frames when there is no such
/// frame; [`OutputError::Hdf5`], [`OutputError::Malformed`] or [`OutputError::Io`]
/// when a file cannot be read or written.
pub fn draw(run: &RunReader, frame: Option<u64>, out: &Path) -> Result<(), OutputError> {
    let frame = choose(run.frames()?, frame)?;
    let header = run.header()?;
    let scene = Scene::read(run, &frame, header.dimension)?;
    let mut view = View::new(header.dimension);
    let height = fit(&mut view, &scene);

    let mut canvas = Canvas::new(WIDTH * SUPERSAMPLING, height * SUPERSAMPLING);
    scene.paint(&mut canvas, &view);
    annotation::Annotation {
        title: header.case_name,
        time: frame.time,
        scene: &scene,
        view: &view,
        pixel: SUPERSAMPLING as f64,
    }
    .draw(&mut canvas)
    .map_err(|reason| OutputError::InvalidData {
        what: format!("text of picture {}", out.display()),
        reason,
    })?;
    let png = canvas.shrunk(SUPERSAMPLING);
    replace_file_with(out, Durability::Process, |path| {
        png.write(std::fs::File::create(path).at("create", path)?)
            .map_err(std::io::Error::other)
            .at("write", path)
    })
}

fn choose(frames: Vec<FrameInfo>, wanted: Option<u64>) -> Result<FrameInfo, OutputError> {
    let (count, last) = (frames.len(), frames.last().map(|frame| frame.index));
    let wanted = wanted.or(last);
    frames.into_iter().find(|frame| Some(frame.index) == wanted).ok_or_else(|| {
        OutputError::InvalidData {
            what: wanted.map_or("picture".into(), |index| format!("frame {index}")),
            reason: match last {
                Some(last) => format!("there is no such frame; the run has {count}, 0 to {last}"),
                None => "the run has no frames yet".into(),
            },
        }
    })
}

/// Places the scene between the margins and returns the picture's height (pixels).
fn fit(view: &mut View, scene: &Scene) -> usize {
    let (low, high) = view.extent(scene.bounds());
    let size = [0, 1].map(|i| (high[i] - low[i]).max(f64::MIN_POSITIVE));
    let width = WIDTH as f64 - MARGIN.left - MARGIN.right;
    let room = MARGIN.top + MARGIN.bottom;
    let wanted = width / size[0] * size[1] + room;
    let height = wanted.clamp(HEIGHTS.0 as f64, HEIGHTS.1 as f64).round();
    let scale = (width / size[0]).min((height - room) / size[1]);
    let centre = [MARGIN.left + 0.5 * width, MARGIN.top + 0.5 * (height - room)];
    let pixel = SUPERSAMPLING as f64;
    view.place(
        scale * pixel,
        [
            (centre[0] - 0.5 * scale * (low[0] + high[0])) * pixel,
            (centre[1] + 0.5 * scale * (low[1] + high[1])) * pixel,
        ],
    );
    height as usize
}
