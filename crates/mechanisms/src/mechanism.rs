//! Mechanisms: all that the program needs to know of one, as a trait that one file implements.

pub(crate) use crate::change::Change;
pub(crate) use crate::heat_path::HeatPath;
use crate::law_tools::Chain;
use crate::record_to_bias::Prepared;
use coil::{Design, Error, MechanicalState};
use diagnosis::{Active, Parameter, Prior};

/// Part of the chain in which a mechanism acts.
#[derive(Debug, Clone, Copy, PartialEq, Eq)]
pub enum Stage {
    /// Heat flow of coil, spool and surroundings.
    Thermal,
    /// Constants of coil and spool.
    Material,
    /// Bond of coil and spool.
    Bond,
    /// Length and place of every turn.
    Winding,
    /// Index of refraction, polarisation, magnetic fields.
    Optics,
    /// Read-out.
    Electronics,
    /// Thermometer.
    Sensor,
}

impl Stage {
    /// Its name in every output.
    pub const fn name(self) -> &'static str {
        match self {
            Self::Thermal => "thermal",
            Self::Material => "material",
            Self::Bond => "bond",
            Self::Winding => "winding",
            Self::Optics => "optics",
            Self::Electronics => "electronics",
            Self::Sensor => "sensor",
        }
    }
}

/// The facts of a mechanism, without its unknowns and its law; texts longer than a sentence are Markdown.
pub struct Facts<'a> {
    /// Short name in every file and output, in kebab case; `unknown:` stands before the id of one that only describes.
    pub id: &'a str,
    /// Heading of its page.
    pub title: &'a str,
    /// Stage at which it acts.
    pub stage: Stage,
    /// Its law.
    pub equation: &'a str,
    /// Its change of the model, and the key of a coil file that holds it.
    pub place: &'a str,
    /// Its signature in a record.
    pub signature: &'a str,
    /// Literature.
    pub source: &'a str,
    /// Whether it is an explanation.
    pub naming: Naming<'a>,
    /// The path of heat that it is, if it is one.
    pub heat_path: Option<HeatPath>,
    /// Its effect in a steady ramp: a law for each parameter that matters. Empty for one that only describes.
    pub steady: Vec<Steady>,
    /// Part of a record in which it acts.
    pub extent: fn(&Active, &Sight) -> Extent,
    /// Approximation of the extended design in place of the fit.
    pub caveat: fn(&Design) -> Option<&'static str>,
}

impl<'a> Facts<'a> {
    /// A check of the unit itself that decides about it, if it is an explanation.
    pub fn inspection(&self) -> Option<&'a str> {
        match self.naming {
            Naming::Named { inspection, .. } => Some(inspection),
            Naming::Described { .. } => None,
        }
    }
}

/// Formats a number to so many significant digits.
pub type Digits<'a> = &'a dyn Fn(f64, usize) -> String;

/// Whether a mechanism counts as an explanation.
#[derive(Debug, Clone)]
pub enum Naming<'a> {
    /// It explains.
    Named {
        /// The mechanism in a sentence, by the names of its parameters.
        meaning: &'a str,
        /// A check of the unit itself that decides about it.
        inspection: &'a str,
    },
    /// It describes a structure that nothing explains: the verdict stays unknown.
    Described {
        /// The structure in words, from the values of the parameters.
        likeness: fn(&[f64], Digits) -> String,
    },
}

/// Scales of the sizes of effects: the range of the coil, and the noise of the gyroscope.
#[derive(Debug, Clone, Copy, PartialEq)]
pub struct Scene {
    /// The coldest and the hottest that the coil was \[°C\].
    pub temperatures: [f64; 2],
    /// White noise of the rate in a reading of a minute \[deg/h\]: electronics and optics of a noisier gyroscope may be off by more.
    pub noise: f64,
    /// Earth's rate along the gyroscope's axis \[deg/h\], if it was given.
    pub earth: Option<f64>,
}

/// A mechanism as it is offered for a design: its unknowns and where fits of them start.
///
/// With two parameters, as a time constant and an amplitude, fits start at pairs of values:
///
/// ```
/// use diagnosis::{Parameter, Prior};
/// use mechanisms::Offer;
///
/// let amplitude = Parameter::new("amplitude_deg_per_h", Prior::Normal { mean: 0.0, sd: 0.3 });
/// let lag = Parameter::new("lag_s", Prior::LogNormal { median: 600.0, spread: 1.0 });
/// let offer = Offer { parameters: vec![amplitude, lag], choice: None, starts: vec![vec![0.1, 200.0], vec![0.1, 2000.0]] };
/// assert!(offer.starts.iter().all(|start| start.len() == offer.parameters.len()));
/// ```
#[derive(Debug, Clone, PartialEq)]
pub struct Offer {
    /// Its parameters, whose names end in their units.
    pub parameters: Vec<Parameter>,
    /// A further, whole-numbered parameter with its candidates.
    pub choice: Option<(String, Vec<f64>)>,
    /// Values of the parameters, in their order, from which fits start.
    pub starts: Vec<Vec<f64>>,
}

impl Offer {
    /// One parameter on which the response depends smoothly.
    pub fn one(name: &str, prior: Prior, starts: &[f64]) -> Self {
        let starts = starts.iter().map(|v| vec![*v]).collect();
        Self { parameters: vec![Parameter::new(name, prior)], choice: None, starts }
    }
}

/// Effect of a mechanism in a record.
pub enum Effect {
    /// It changes the coil's response.
    Coil(Change),
    /// It acts on the readings, after everything that changes the coil, in the order of the hypothesis.
    Readings(Box<dyn Fn(&mut Readings) + Send + Sync>),
}

/// Readings of thermometer and gyroscope, a value for each row of a record.
pub struct Readings<'a> {
    /// Instants \[s\].
    pub time: &'a [f64],
    /// Readings of the spool's thermometer \[°C\].
    pub thermometer: Vec<f64>,
    /// Readings of the gyroscope \[deg/h\].
    pub rate: Vec<f64>,
}

/// Effect of a mechanism on the sensitivity in a steady ramp.
#[derive(Clone, Copy)]
pub enum Steady {
    /// The first parameter changes the design.
    Design(fn(&Design, f64) -> Design),
    /// One parameter changes the design, or the mechanical state it is in.
    Changes {
        /// Its place among the parameters.
        parameter: usize,
        /// The changed design.
        changed: fn(&Design, f64) -> (Design, MechanicalState),
        /// Condition under which it holds; empty if there is none.
        when: &'static str,
    },
    /// A number of turns changes one layer.
    Rewinds {
        /// Place of the number among the parameters.
        turns: usize,
        /// The design with that layer so rewound.
        changed: fn(&Design, usize, i32) -> Design,
    },
    /// No effect, for this reason.
    Nothing(&'static str),
}

/// Extent of a mechanism in a record; `None` where the question makes no sense.
#[derive(Debug, Clone, Copy, Default, PartialEq)]
pub struct Extent {
    /// Temperatures of the coil \[°C\].
    pub temperature: Option<[f64; 2]>,
    /// Instants \[s\].
    pub time: Option<[f64; 2]>,
    /// Layers, 1 = innermost.
    pub layers: Option<[usize; 2]>,
}

impl Extent {
    /// No temperatures, instants or layers in particular.
    pub fn everywhere(_: &Active, _: &Sight) -> Self {
        Self::default()
    }
}

/// Facts from which a mechanism states its [`Extent`].
pub struct Sight<'a> {
    /// The design.
    pub design: &'a Design,
    /// First and last value of the mechanism's choice that is not excluded.
    pub choices: Option<[f64; 2]>,
    /// The first record and what the mechanism changes in it.
    pub first: Option<(&'a Prepared, &'a Change)>,
}

/// Physics that a coil's nominal model may leave out: everything that the program says, computes and writes of it.
///
/// No method has a default and no field of [`Facts`] either, so that a forgotten part is an error of the compiler.
pub trait Mechanism: Send + Sync {
    /// The facts, without its unknowns and its law.
    fn facts(&self) -> Facts<'_>;

    /// Its unknowns with their priors. `None` if the design leaves it no place.
    fn offer(&self, design: &Design, scene: &Scene) -> Option<Offer>;

    /// Its law: what it does in a record.
    ///
    /// # Errors
    /// [`Error`] if a changed coil cannot be modelled.
    fn effect(&self, chain: &Chain, record: &Prepared, active: &Active) -> Result<Effect, Error>;

    /// The design with it put in at its place; `None` if a design has no place for it, or the place is taken.
    fn extended(&self, design: &Design, active: &Active) -> Option<Design>;

    /// Further columns of a record that its law sees.
    fn columns(&self) -> Vec<&str>;
}

/// A mechanism that explains, in one literal without defaults: the fields of [`Facts`] and the methods of [`Mechanism`].
pub(crate) struct Named {
    pub(crate) id: &'static str,
    pub(crate) title: &'static str,
    pub(crate) stage: Stage,
    pub(crate) equation: &'static str,
    pub(crate) place: &'static str,
    pub(crate) signature: &'static str,
    pub(crate) source: &'static str,
    pub(crate) meaning: &'static str,
    pub(crate) inspection: &'static str,
    pub(crate) columns: &'static [&'static str],
    pub(crate) heat_path: Option<fn() -> HeatPath>,
    pub(crate) steady: &'static [Steady],
    pub(crate) extent: fn(&Active, &Sight) -> Extent,
    pub(crate) caveat: fn(&Design) -> Option<&'static str>,
    pub(crate) offer: fn(&Design, &Scene) -> Option<Offer>,
    pub(crate) effect: fn(&Chain, &Prepared, &Active) -> Result<Effect, Error>,
    pub(crate) extended: fn(&Design, &Active) -> Option<Design>,
}

impl Mechanism for Named {
    fn facts(&self) -> Facts<'_> {
        let &Self { id, title, stage, equation, place, signature, source, meaning, inspection, extent, caveat, .. } = self;
        let (naming, heat_path, steady) =
            (Naming::Named { meaning, inspection }, self.heat_path.map(|path| path()), self.steady.to_vec());
        Facts { id, title, stage, equation, place, signature, source, naming, heat_path, steady, extent, caveat }
    }

    fn offer(&self, design: &Design, scene: &Scene) -> Option<Offer> {
        (self.offer)(design, scene)
    }

    fn effect(&self, chain: &Chain, record: &Prepared, active: &Active) -> Result<Effect, Error> {
        (self.effect)(chain, record, active)
    }

    fn extended(&self, design: &Design, active: &Active) -> Option<Design> {
        (self.extended)(design, active)
    }

    fn columns(&self) -> Vec<&str> {
        self.columns.to_vec()
    }
}

/// A mechanism that only describes a structure and has no place in a design, in one literal without defaults.
pub(crate) struct Described {
    pub(crate) id: &'static str,
    pub(crate) title: &'static str,
    pub(crate) stage: Stage,
    pub(crate) equation: &'static str,
    pub(crate) place: &'static str,
    pub(crate) signature: &'static str,
    pub(crate) source: &'static str,
    pub(crate) offer: fn(&Scene) -> Offer,
    /// Its change of a record, by the values of its parameters.
    pub(crate) law: fn(&Prepared, &[f64]) -> Change,
    /// As in [`Naming::Described`].
    pub(crate) likeness: fn(&[f64], Digits) -> String,
}

impl Mechanism for Described {
    fn facts(&self) -> Facts<'_> {
        let &Self { id, title, stage, equation, place, signature, source, likeness, .. } = self;
        let (naming, steady, extent) = (Naming::Described { likeness }, Vec::new(), Extent::everywhere);
        Facts { id, title, stage, equation, place, signature, source, naming, heat_path: None, steady, extent, caveat: |_| None }
    }

    fn offer(&self, _: &Design, scene: &Scene) -> Option<Offer> {
        Some((self.offer)(scene))
    }

    fn effect(&self, _: &Chain, record: &Prepared, active: &Active) -> Result<Effect, Error> {
        Ok(Effect::Coil((self.law)(record, &active.values)))
    }

    fn extended(&self, _: &Design, _: &Active) -> Option<Design> {
        None
    }

    fn columns(&self) -> Vec<&str> {
        Vec::new()
    }
}

/// Every combination of a value from each list.
pub(crate) fn grid(lists: &[&[f64]]) -> Vec<Vec<f64>> {
    lists.iter().fold(vec![Vec::new()], |grid, list| {
        grid.iter().flat_map(|v| list.iter().map(|x| [v.as_slice(), &[*x]].concat())).collect()
    })
}

/// So many values evenly over a range.
pub(crate) fn across(range: [f64; 2], count: u32) -> Vec<f64> {
    (0..count).map(|k| range[0] + (range[1] - range[0]) * (f64::from(k) + 0.5) / f64::from(count)).collect()
}
