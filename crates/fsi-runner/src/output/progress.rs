//! What the user sees while a run goes on.

use indicatif::{ProgressBar, ProgressStyle};
use std::io::IsTerminal;
use std::time::{Duration, Instant};

/// Positions of the bar; indicatif counts whole units.
const RESOLUTION: f64 = 10_000.0;

/// Between two lines where there is no terminal.
const LINE_INTERVAL: Duration = Duration::from_secs(10);

/// Between two refreshes of the bar.
const BAR_INTERVAL: Duration = Duration::from_millis(200);

/// The state of a run at one step.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct ProgressState<'a> {
    /// Simulated time (s).
    pub time: f64,
    /// Coupled steps done, those before a resume included.
    pub step: u64,
    /// Fluid particles and material points.
    pub particles: usize,
    /// The step's length (s).
    pub time_step: f64,
    /// What limits it, e.g. `sound speed`.
    pub limiting_term: &'a str,
}

/// A bar on a terminal, otherwise a line every few seconds; both on stderr.
pub struct Progress {
    bar: Option<ProgressBar>,
    start_time: f64,
    end_time: f64,
    start_step: u64,
    begun: Instant,
    shown: Instant,
}

impl Progress {
    /// Begins at `start_time` (s) and `start_step`, both 0 unless resumed.
    pub fn start(start_time: f64, start_step: u64, end_time: f64) -> Self {
        let bar = std::io::stderr().is_terminal().then(|| {
            let bar = ProgressBar::new(RESOLUTION as u64);
            let style = ProgressStyle::with_template("{bar:30} {percent:>3}%  {msg}");
            // The template is a constant; should it not parse, the plain bar does.
            bar.set_style(style.unwrap_or_else(|_| ProgressStyle::default_bar()));
            bar
        });
        let now = Instant::now();
        Self { bar, start_time, end_time, start_step, begun: now, shown: now }
    }

    /// Shows the state; cheap when it is too early to show anything.
    pub fn update(&mut self, state: &ProgressState<'_>) {
        let interval = if self.bar.is_some() { BAR_INTERVAL } else { LINE_INTERVAL };
        if self.shown.elapsed() < interval {
            return;
        }
        self.shown = Instant::now();
        let done = (state.time / self.end_time).clamp(0.0, 1.0);
        let text = self.line(state, self.begun.elapsed());
        match &self.bar {
            Some(bar) => {
                bar.set_position((done * RESOLUTION) as u64);
                bar.set_message(text);
            }
            None => eprintln!("{:>3.0}%  {text}", done * 100.0),
        }
    }

    /// Removes the bar, e.g. before a summary or an error.
    pub fn finish(&self) {
        if let Some(bar) = &self.bar {
            bar.finish_and_clear();
        }
    }

    /// Prints or logs without tearing the bar.
    pub fn suspend<T>(&self, print: impl FnOnce() -> T) -> T {
        match &self.bar {
            Some(bar) => bar.suspend(print),
            None => print(),
        }
    }

    fn line(&self, state: &ProgressState<'_>, elapsed: Duration) -> String {
        let seconds = elapsed.as_secs_f64().max(1e-9);
        let rate = (state.step - self.start_step.min(state.step)) as f64 / seconds;
        let advance = state.time - self.start_time;
        let left = if advance > 0.0 {
            duration(seconds * (self.end_time - state.time).max(0.0) / advance)
        } else {
            "?".into()
        };
        format!(
            "{:.4}/{} s  step {}  {:.1} steps/s  {:.2} M particle-steps/s  dt {:.3e} s ({})  {left} left",
            state.time,
            self.end_time,
            state.step,
            rate,
            rate * state.particles as f64 * 1e-6,
            state.time_step,
            state.limiting_term,
        )
    }
}

/// `1 h 02 min`, `3 min 20 s` or `12 s`.
pub fn duration(seconds: f64) -> String {
    let whole = seconds.max(0.0).round() as u64;
    match whole {
        0..60 => format!("{whole} s"),
        60..3600 => format!("{} min {:02} s", whole / 60, whole % 60),
        _ => format!("{} h {:02} min", whole / 3600, whole % 3600 / 60),
    }
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn rates_and_time_left_count_from_the_resume() {
        let progress = Progress::start(1.0, 100, 3.0);
        let state = ProgressState {
            time: 1.5,
            step: 300,
            particles: 50_000,
            time_step: 2.5e-3,
            limiting_term: "sound speed",
        };
        assert_eq!(
            progress.line(&state, Duration::from_secs(10)),
            "1.5000/3 s  step 300  20.0 steps/s  1.00 M particle-steps/s  \
             dt 2.500e-3 s (sound speed)  30 s left"
        );
    }

    #[test]
    fn durations_read_well() {
        assert_eq!([12.4, 200.0, 3720.0].map(duration), ["12 s", "3 min 20 s", "1 h 02 min"]);
    }
}
