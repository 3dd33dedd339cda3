//! Contributions to the bias along the fibre: of every turn, and of the tails.

use bias::Bias;
use bias::units::DEG_PER_H_PER_RAD_PER_S;
use charts::signed;
use coil::{ThermalState, TurnFields};

use crate::input::CoilCase;

/// What the fibre's parts add to the bias, tails and turns apart.
pub struct Contributions {
    /// Of each turn, in the winding's order.
    pub turns: Vec<Bias>,
    /// Of both tails together; they expand freely at the bore's temperature.
    pub tails: Bias,
    /// Whether there are tails.
    tailed: bool,
}

impl Contributions {
    /// Contributions to the bias while the state changes by `change` per second \[°/h\], the mechanics in their nominal state.
    ///
    /// # Errors
    /// [`bias::Error`] if an optical constant is out of range, with which no coil could have been simulated.
    pub(crate) fn of(case: &CoilCase, fields: &TurnFields, change: &ThermalState) -> Result<Self, bias::Error> {
        let (optics, winding) = (&case.design.optics, &case.winding);
        let coefficients = optics.coefficients(winding.length())?;
        let rates = fields.at(change);
        let of =
            |weight, temperature, axial, radial| coefficients.bias(weight, temperature, axial, radial) * DEG_PER_H_PER_RAD_PER_S;
        let turn = |(i, weight): (usize, f64)| of(weight, rates.temperature[i], rates.axial[i], rates.radial[i]);
        let free = optics.thermal_expansion * rates.bore;
        let tails = winding.spec().tails;
        Ok(Self {
            turns: winding.weights().into_iter().enumerate().map(turn).collect(),
            tails: of(winding.tail_weight(), rates.bore, free, free),
            tailed: tails.cw > 0.0 || tails.ccw > 0.0,
        })
    }

    /// All of them times a factor.
    pub(crate) fn scaled(self, factor: f64) -> Self {
        let turns = self.turns.into_iter().map(|turn| turn * factor).collect();
        Self { turns, tails: self.tails * factor, ..self }
    }

    /// A part of each turn's contribution.
    pub(crate) fn part(&self, part: fn(&Bias) -> f64) -> Vec<f64> {
        self.turns.iter().map(part).collect()
    }

    /// What a part adds up to.
    pub(crate) fn sum(&self, part: fn(&Bias) -> f64) -> Sum {
        Sum { turns: self.turns.iter().map(part).sum(), tails: self.tailed.then(|| part(&self.tails)) }
    }
}

/// Sum over the turns, and what tails add to it, if there are any.
#[derive(Clone, Copy)]
pub(crate) struct Sum {
    turns: f64,
    tails: Option<f64>,
}

/// Beside sums of turns and of tails.
pub(crate) const OF_TAILS: &str = "The thermal phase of the tails cancels against that of the turns, so the tails' sum is no measure of what other tails would \
    do: trim tells that.";

impl Sum {
    /// The sum over the whole fibre, in words.
    pub(crate) fn whole(self, decimals: usize) -> String {
        let word = if self.tails.is_some() { "together" } else { "sum" };
        format!("{word} {}", signed(self.turns + self.tails.unwrap_or(0.0), decimals))
    }

    /// The same, with what it comes from.
    pub(crate) fn apart(self, decimals: usize) -> String {
        let of = |tails| format!("turns {}, tails {}, ", signed(self.turns, decimals), signed(tails, decimals));
        self.tails.map_or(String::new(), of) + &self.whole(decimals)
    }
}
