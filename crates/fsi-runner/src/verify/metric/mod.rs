//! Metrics: one number from a run, and the same number from the reference.

mod acceleration;
mod amplitude_loss;
mod cantilever;
mod frequency;
mod front;
mod history;
mod peak;
mod profile_error;
mod statistic;
mod stress_field;

pub use acceleration::Acceleration;
pub use amplitude_loss::AmplitudeLoss;
pub use cantilever::{CantileverCrest, LoadShape};
pub use frequency::Frequency;
pub use front::FrontBand;
pub use history::{HistoryAt, HistoryDeviation};
pub use peak::{Arrival, Peak, Threshold};
pub use profile_error::{Axis, Norm, ProfileError, Quantity};
pub use statistic::{Divisor, Statistic, Take};
pub use stress_field::{Mask, StressComponent, StressField};

use super::{Histories, PointSource, ReferenceTable, Signal, VerifyError};
use serde::Deserialize;
use std::ops::RangeInclusive;

/// What is measured; every variant is defined in `docs/verification.md`.
#[derive(Debug, Clone, PartialEq, Deserialize)]
#[serde(deny_unknown_fields)]
pub enum Metric {
    /// A statistic of one history: final value, maximum, mean, rise, …
    Statistic(Statistic),
    /// Relative L2 error of cell-averaged stress.
    StressField(StressField),
    /// Distance of a front from the band of several experiments.
    FrontBand(FrontBand),
    /// A history's value at one time.
    HistoryAt(HistoryAt),
    /// Root mean square difference from a reference history.
    HistoryDeviation(HistoryDeviation),
    /// The largest value of a history.
    Peak(Peak),
    /// The time at which a history first exceeds a threshold.
    Arrival(Arrival),
    /// Angular frequency from zero crossings.
    Frequency(Frequency),
    /// Loss of amplitude of a vibration over a number of periods.
    AmplitudeLoss(AmplitudeLoss),
    /// Steady acceleration from a history of displacement.
    Acceleration(Acceleration),
    /// Stress or displacement of all points beside a profile along one axis.
    ProfileError(ProfileError),
    /// Crest displacement against beam theory with the measured base reactions.
    CantileverCrest(CantileverCrest),
}

/// What a metric yields.
#[derive(Debug, Clone, PartialEq)]
pub struct Measurement {
    /// The value of this run.
    pub value: f64,
    /// Its unit; `1` if it is a ratio.
    pub unit: String,
    /// The same value from the reference files, where they give one.
    pub reference: Option<f64>,
    /// Where and when, for the reader of the table.
    pub detail: String,
}

/// The evidence that a metric looks at.
pub(super) struct Evidence<'a> {
    /// Gauges and ledger of the run.
    pub histories: &'a Histories,
    /// Points of the last frame.
    pub points: &'a dyn PointSource,
    /// The reference files of the check, in its order.
    pub references: &'a [ReferenceTable],
}

impl Metric {
    /// How many reference files the metric takes.
    pub(super) fn reference_count(&self) -> RangeInclusive<usize> {
        match self {
            Self::Statistic(_)
            | Self::Frequency(_)
            | Self::AmplitudeLoss(_)
            | Self::Acceleration(_)
            | Self::CantileverCrest(_) => 0..=0,
            Self::StressField(_) | Self::HistoryDeviation(_) => 1..=1,
            Self::FrontBand(_) => 1..=usize::MAX,
            Self::HistoryAt(_) | Self::Peak(_) | Self::Arrival(_) | Self::ProfileError(_) => 0..=1,
        }
    }

    /// Whether the metric yields a reference value from so many files.
    pub(super) fn gives_reference(&self, files: usize) -> bool {
        match self {
            Self::HistoryAt(_) | Self::Peak(_) | Self::Arrival(_) => files > 0,
            Self::CantileverCrest(_) => true,
            Self::Statistic(_)
            | Self::StressField(_)
            | Self::FrontBand(_)
            | Self::HistoryDeviation(_)
            | Self::AmplitudeLoss(_)
            | Self::Acceleration(_)
            | Self::ProfileError(_)
            | Self::Frequency(_) => false,
        }
    }

    /// The signals that the metric reads.
    pub(super) fn signals(&self) -> Vec<&Signal> {
        match self {
            Self::Statistic(m) => match &m.divide_by {
                Divisor::Nothing | Divisor::Scale(_) => vec![&m.signal],
                Divisor::Same(other) | Divisor::First(other) => vec![&m.signal, other],
            },
            Self::StressField(_) | Self::ProfileError(_) => vec![],
            Self::FrontBand(m) => vec![&m.signal],
            Self::HistoryAt(m) => vec![&m.signal],
            Self::HistoryDeviation(m) => vec![&m.signal],
            Self::Peak(m) => vec![&m.signal],
            Self::Arrival(m) => vec![&m.signal],
            Self::Frequency(m) => vec![&m.signal],
            Self::AmplitudeLoss(m) => vec![&m.signal],
            Self::Acceleration(m) => vec![&m.signal],
            Self::CantileverCrest(m) => vec![&m.displacement, &m.force, &m.moment],
        }
    }

    /// Measures the run.
    pub(super) fn measure(&self, evidence: &Evidence) -> Result<Measurement, VerifyError> {
        match self {
            Self::Statistic(m) => m.measure(evidence),
            Self::StressField(m) => m.measure(evidence),
            Self::FrontBand(m) => m.measure(evidence),
            Self::HistoryAt(m) => m.measure(evidence),
            Self::HistoryDeviation(m) => m.measure(evidence),
            Self::Peak(m) => m.measure(evidence),
            Self::Arrival(m) => m.measure(evidence),
            Self::Frequency(m) => m.measure(evidence),
            Self::AmplitudeLoss(m) => m.measure(evidence),
            Self::Acceleration(m) => m.measure(evidence),
            Self::ProfileError(m) => m.measure(evidence),
            Self::CantileverCrest(m) => m.measure(evidence),
        }
    }
}
