//! A recording: instants and named channels.

use crate::Error;
use crate::series::check_length;

/// Relation of a channel's value to its instant.
#[derive(Debug, Clone, Copy, PartialEq, Eq)]
pub enum Sampling {
    /// The value at the instant.
    Momentary,
    /// The mean over the interval that ends at the instant.
    Mean,
}

/// A column of a recording.
#[derive(Debug, Clone, PartialEq)]
pub struct Channel {
    /// Its name.
    pub name: String,
    /// Its unit, for messages.
    pub unit: String,
    /// One value for each instant; NaN where it is missing.
    pub values: Vec<f64>,
    /// Meaning of a value.
    pub sampling: Sampling,
}

/// Instants and channels as they were recorded: nothing about them is checked but their shape.
#[derive(Debug, Clone, PartialEq)]
pub struct Recording {
    time: Vec<f64>,
    channels: Vec<Channel>,
}

impl Recording {
    /// A recording of finite instants \[s\], in any order.
    ///
    /// # Errors
    /// [`Error::Length`], [`Error::Name`] for channels of other lengths or one name; [`Error::Value`] for an instant that is not finite.
    pub fn new(time: Vec<f64>, channels: Vec<Channel>) -> Result<Self, Error> {
        if let Some(row) = time.iter().position(|instant| !instant.is_finite()) {
            return Err(Error::Value { name: "time".into(), row, value: time[row] });
        }
        for (i, channel) in channels.iter().enumerate() {
            check_length(&channel.name, channel.values.len(), time.len())?;
            if channels[..i].iter().any(|other| other.name == channel.name) {
                return Err(Error::Name(channel.name.clone()));
            }
        }
        Ok(Self { time, channels })
    }

    /// Instants \[s\].
    pub fn time(&self) -> &[f64] {
        &self.time
    }

    /// Channels.
    pub fn channels(&self) -> &[Channel] {
        &self.channels
    }

    /// The channel of a name.
    pub fn channel(&self, name: &str) -> Option<&Channel> {
        self.channels.iter().find(|channel| channel.name == name)
    }

    /// Makes NaN of values that are not used.
    pub(crate) fn mask(&mut self, masks: &[Vec<bool>]) {
        for (channel, mask) in self.channels.iter_mut().zip(masks) {
            channel.values.iter_mut().zip(mask).filter(|(_, used)| !**used).for_each(|(value, _)| *value = f64::NAN);
        }
    }

    /// The same channels at other instants, each made by `of`, which keeps names apart and gives one value for each.
    pub(crate) fn with(&self, time: Vec<f64>, of: impl Fn(&Channel) -> Channel) -> Self {
        Self { channels: self.channels.iter().map(of).collect(), time }
    }

    /// Some rows in a given order, e.g. those that a [`crate::check::Report`] keeps.
    ///
    /// # Panics
    /// If a row is not less than the number of instants.
    pub fn select(&self, rows: &[usize]) -> Self {
        let of = |series: &[f64]| rows.iter().map(|&row| series[row]).collect();
        self.with(of(&self.time), |channel| Channel { values: of(&channel.values), ..channel.clone() })
    }
}
