//! Small laws: a shape of a quantity, alone or times another one, at a place of a nominal model; and all of them that a model can have.

use super::plant::{Acts, Kind, Moment, Place, Quantity};
use super::shapes::{self, Past, Rates, Shape};

/// Weight of what textbooks begin with over that of the special forms: strong evidence on the scale of Kass and Raftery (1995) is needed against it.
const SIMPLE: f64 = 20.0;

/// Factor by which a law multiplies its shape.
#[derive(Debug, Clone, Copy, PartialEq)]
pub(crate) enum Factor {
    One,
    /// A quantity that is nothing at 0.
    Flow(usize),
    /// The nominal model's own flow or loss at the place.
    Own,
}

/// Argument of a shape.
#[derive(Debug, Clone, Copy, PartialEq)]
pub(crate) enum Of {
    Quantity(usize),
    /// The difference of two quantities in one unit.
    Difference(usize, usize),
    /// The nominal model's own flow or loss at the first place, over the range of the larger of the two.
    Place(usize, usize),
}

/// A small law.
#[derive(Debug, Clone, Copy, PartialEq)]
pub(crate) struct Law {
    pub(crate) shape: Shape,
    pub(crate) of: Of,
    pub(crate) factor: Factor,
    pub(crate) at: usize,
    /// The place that loses what the law adds at the other.
    pub(crate) from: Option<usize>,
    /// A place of the same kind, where the same law acts by what is that place's own.
    pub(crate) also: Option<usize>,
}

impl Law {
    /// A shape of a quantity added at a place.
    pub(crate) fn added(shape: Shape, quantity: usize, at: usize) -> Self {
        Self { shape, of: Of::Quantity(quantity), factor: Factor::One, at, from: None, also: None }
    }
}

/// A quantity's middle and half of its range, or 0 and its largest size; its rate; and how large what is at a place goes.
#[derive(Debug, Clone)]
pub(crate) struct Scales {
    pub(crate) quantities: Vec<(f64, f64)>,
    pub(crate) rates: Vec<Rates>,
    pub(crate) places: Vec<f64>,
    pub(crate) duration: f64,
}

impl Scales {
    fn x(&self, of: Of, q: &[f64], nominal: &[f64]) -> f64 {
        let one = |i: usize| (q[i] - self.quantities[i].0) / self.quantities[i].1;
        match of {
            Of::Quantity(i) => one(i),
            Of::Difference(a, b) => (q[b] - q[a]) / self.quantities[a].1.max(self.quantities[b].1),
            Of::Place(at, other) => nominal[at] / (2.0 * self.places[at].max(self.places[other])),
        }
    }

    /// Half of the range.
    fn half(&self, of: Of) -> f64 {
        match of {
            Of::Quantity(i) => self.quantities[i].1,
            Of::Difference(..) | Of::Place(..) => 1.0,
        }
    }

    fn rates(&self, of: Of) -> Rates {
        match of {
            Of::Quantity(i) | Of::Difference(i, _) => self.rates[i],
            // over any time there is none: no law asks for the rate of what is at a place
            Of::Place(..) => Rates { over: f64::INFINITY, largest: 1.0 },
        }
    }
}

impl Law {
    /// Adds the law, with its size and further parameters, to what is at its place.
    pub(crate) fn act(
        &self,
        values: &[f64],
        scales: &Scales,
        nominal: &[f64],
        own: (&[Place], &mut [Past; 2]),
        moment: &mut Moment<'_>,
    ) {
        let (places, [past, beside]) = own;
        self.act_at(self.at, self.of, values, scales, nominal, past, moment);
        let beside_of = |also: usize| match self.of {
            Of::Place(other, own) => Some(Of::Place(own, other)),
            _ => places[also].own.map(Of::Quantity),
        };
        if let Some((also, of)) = self.also.and_then(|also| Some((also, beside_of(also)?))) {
            self.act_at(also, of, values, scales, nominal, beside, moment);
        }
    }

    #[allow(clippy::too_many_arguments, reason = "one call")]
    fn act_at(
        &self,
        at: usize,
        of: Of,
        values: &[f64],
        scales: &Scales,
        nominal: &[f64],
        past: &mut Past,
        moment: &mut Moment<'_>,
    ) {
        let x = scales.x(of, moment.quantities, nominal) * scales.half(of) / scales.half(self.of);
        let shape = self.shape.at(x, moment.step, &scales.rates(of), &values[1..], past);
        let by = match self.factor {
            Factor::One => scales.places[self.at],
            Factor::Flow(i) => scales.places[self.at] * moment.quantities[i] / scales.quantities[i].1,
            Factor::Own => nominal[at],
        };
        let added = values[0] * by * shape;
        moment.places[at] += added;
        if let Some(from) = self.from {
            moment.places[from] -= added;
        }
    }

    /// Weight before anything is seen: textbooks begin with a first order, a lag and an exchange, and come to the special forms later.
    pub(crate) fn weight(&self) -> f64 {
        match self.shape {
            Shape::Linear | Shape::Lag => SIMPLE,
            _ => 1.0,
        }
    }

    /// In words.
    pub(crate) fn words(&self, quantities: &[Quantity], places: &[Place]) -> String {
        let place = match self.also {
            Some(also) => format!("{} and, alike, to {}", places[self.at].name, places[also].name),
            None => places[self.at].name.to_owned(),
        };
        let of = match self.of {
            Of::Quantity(i) => quantities[i].name.to_owned(),
            Of::Difference(a, b) => format!("{} less {}", quantities[b].name, quantities[a].name),
            Of::Place(at, _) => places[at].name.to_owned(),
        };
        let goes = self.shape.words(&of);
        match (self.factor, self.from) {
            (_, Some(from)) => format!("a flow from {} to {place} {goes}", places[from].name),
            (Factor::One, None) => format!("added to {place} {goes}"),
            (Factor::Own, None) => format!("a change of {place} {goes}"),
            (Factor::Flow(i), None) => format!("added to {place}, {} times what goes {goes}", quantities[i].name),
        }
    }
}

/// All laws that a model with these quantities and places can have.
pub(crate) fn all(quantities: &[Quantity], places: &[Place]) -> Vec<Law> {
    let mut laws = Vec::new();
    for (at, place) in places.iter().enumerate() {
        if place.acts != Acts::Loss {
            laws.extend(alone(quantities, at));
        }
        laws.extend(products(quantities, place, at));
        laws.extend(exchanges(quantities, places, at));
        laws.extend(alike(quantities, places, at));
        laws.extend(shared(places, at));
    }
    laws
}

fn alone(quantities: &[Quantity], at: usize) -> impl Iterator<Item = Law> {
    let of = move |(i, q): (usize, &Quantity)| shapes::alone(q.kind).iter().map(move |shape| Law::added(*shape, i, at));
    quantities.iter().enumerate().flat_map(of)
}

/// A change of what is at a place, unless that is only read there, and products with a flow.
fn products(quantities: &[Quantity], place: &Place, at: usize) -> Vec<Law> {
    let own = (!matches!(place.acts, Acts::Reading(_))).then_some(Factor::Own);
    let flows = (0..quantities.len()).filter(|i| place.acts != Acts::Loss && quantities[*i].kind == Kind::Flow).map(Factor::Flow);
    let with = |factor: Factor| {
        let of = move |(i, q): (usize, &Quantity)| {
            shapes::in_product(q.kind).iter().map(move |shape| Law {
                shape: *shape,
                of: Of::Quantity(i),
                factor,
                at,
                from: None,
                also: None,
            })
        };
        // a flow times itself is its square
        quantities.iter().enumerate().filter(move |(i, _)| factor != Factor::Flow(*i)).flat_map(of).collect::<Vec<_>>()
    };
    own.into_iter().chain(flows).flat_map(with).collect()
}

/// The same law at two places of a kind, at each by its own quantity.
fn alike(quantities: &[Quantity], places: &[Place], at: usize) -> Vec<Law> {
    let place = &places[at];
    let Some(own) = place.own else { return Vec::new() };
    let kind = std::mem::discriminant(&place.acts);
    let like = |other: &Place| {
        let same = std::mem::discriminant(&other.acts) == kind && other.unit == place.unit;
        same && other.own.is_some_and(|o| o != own && quantities[o].unit == quantities[own].unit)
    };
    let of = |factor: Factor, shapes: &'static [Shape], also: usize| {
        shapes.iter().map(move |shape| Law { factor, also: Some(also), ..Law::added(*shape, own, at) })
    };
    let mut laws = Vec::new();
    for also in (at + 1..places.len()).filter(|also| like(&places[*also])) {
        if place.acts != Acts::Loss {
            laws.extend(of(Factor::One, shapes::alone(quantities[own].kind), also));
        }
        if !matches!(place.acts, Acts::Reading(_)) {
            laws.extend(of(Factor::Own, shapes::in_product(quantities[own].kind), also));
        }
    }
    laws
}

/// Flows from another place into this one by the difference of the quantities that the two fill.
fn exchanges(quantities: &[Quantity], places: &[Place], at: usize) -> Vec<Law> {
    let Some(own) = places[at].own.filter(|_| places[at].acts == Acts::Flow) else { return Vec::new() };
    let of = |from: usize| {
        let other = places[from]
            .own
            .filter(|_| places[from].acts == Acts::Flow)
            .filter(|other| quantities[*other].unit == quantities[own].unit)?;
        Some(Law { shape: Shape::Linear, of: Of::Difference(own, other), factor: Factor::One, at, from: Some(from), also: None })
    };
    let passed = |from: usize| {
        let source = places[from].own.filter(|_| from != at && places[from].acts == Acts::Flow);
        let source = source.filter(|source| quantities[*source].unit == quantities[own].unit);
        let law = move |shape: &Shape| Some(Law { from: Some(from), ..Law::added(*shape, source?, at) });
        shapes::PASSED_ON.iter().filter_map(law).collect::<Vec<_>>()
    };
    (0..at).filter_map(of).chain((0..places.len()).flat_map(passed)).collect()
}

/// Two flows of a kind of which each changes with the other, alike: they come from one supply.
fn shared(places: &[Place], at: usize) -> Vec<Law> {
    let flows = |place: usize| places[place].acts == Acts::Flow && places[place].unit == places[at].unit;
    let law = |also: usize| Law {
        shape: Shape::Linear,
        of: Of::Place(also, at),
        factor: Factor::Own,
        at,
        from: None,
        also: Some(also),
    };
    (at + 1..places.len()).filter(|also| flows(at) && flows(*also)).map(law).collect()
}
