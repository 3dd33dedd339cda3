//! Error of the steady sensitivity against the number of unknowns, beside an estimate from the next finer mesh.

use charts::{Axis, Figure, Panel, Series, Style};
use coil::{COARSE, MeshFineness, Model, SAFETY};
use serde::{Deserialize, Serialize};

use super::document::Document;
use crate::Error;
use crate::cache::Cache;
use crate::input::CoilCase;

/// Orders whose error is shown.
const ORDERS: std::ops::RangeInclusive<usize> = 3..=8;

/// A mesh of this order with as many layers towards the coil's edges as the program's own meshes have: half the order.
fn mesh(order: usize) -> MeshFineness {
    MeshFineness { order, layers: order / 2, ratio: COARSE.ratio }
}

/// The reference that is taken for exact: two orders and a layer beyond the finest mesh behind an estimate.
const REFERENCE: usize = 12;

/// Convergence of a coil's steady sensitivity.
#[derive(Debug, Clone, PartialEq, Serialize, Deserialize)]
pub struct Convergence {
    /// Unknowns, sensitivity, and sensitivity of the next finer mesh, by order.
    meshes: Vec<(f64, f64, f64)>,
    /// Unknowns and sensitivity of the reference.
    reference: (f64, f64),
}

impl Convergence {
    /// Solves on every mesh, about a second, or finds it in `cache`.
    ///
    /// # Errors
    /// [`files::Error::Coil`] if the coil cannot be solved.
    pub fn measure(case: &CoilCase, cache: &Cache) -> Result<Self, Error> {
        let solve = |order: usize| -> Result<(f64, f64), coil::Error> {
            let model = Model::new(&case.design, &mesh(order))?;
            Ok((model.unknowns() as f64, model.sensitivity()?.total()))
        };
        let build = || -> Result<Self, coil::Error> {
            let meshes = ORDERS.map(|p| solve(p).and_then(|(n, s)| Ok((n, s, solve(p + 2)?.1)))).collect::<Result<_, _>>()?;
            Ok(Self { meshes, reference: solve(REFERENCE)? })
        };
        let measured = cache.load_or_build("convergence", &case.design, build);
        measured.map(|(measured, _)| measured).map_err(Error::of_coil(&case.file))
    }
}

/// The convergence of a coil's steady sensitivity, as a file.
///
/// # Errors
/// [`files::Error::Coil`] if the coil cannot be solved.
pub fn convergence(case: &CoilCase) -> Result<Document, Error> {
    let measured = Convergence::measure(case, &Cache::NONE)?;
    let figure = figure(case, &measured);
    Ok((figure.id, figure.document()))
}

pub(super) fn figure(case: &CoilCase, measured: &Convergence) -> Figure<'static> {
    let (unknowns, exact) = measured.reference;
    let floor = f64::EPSILON * exact.abs();
    let series = |name: &str, kind: u8, error: fn(&(f64, f64, f64), f64) -> f64| {
        let points = measured.meshes.iter().map(|s| (s.0, error(s, exact).max(floor))).collect();
        Series::new(name, Style::Marked(kind), points)
    };
    let truth = format!("distance to order {REFERENCE}; from left to right orders {} to {}", ORDERS.start(), ORDERS.end());
    Figure {
        id: "convergence",
        title: "Convergence of the steady sensitivity".into(),
        description:
            "Error of the steady sensitivity against the number of unknowns, both axes logarithmic: the distance to a much \
                      finer mesh, and twice the distance to the next finer one, which lies above it."
                .into(),
        caption: format!(
            "{}: meshes of order {} to {}, with half as many layers towards the coil's edges; order {} is that of fields and profiles. \
             Reference: order {REFERENCE}, {} layers, {unknowns} unknowns. The next finer mesh is two orders and a layer finer. \
             The program reports the sensitivity from another mesh, of order 7, and estimates its error from lower orders and a coarser grading.",
            case.name,
            ORDERS.start(),
            ORDERS.end(),
            COARSE.order,
            REFERENCE / 2
        ),
        columns: 1,
        panels: vec![Panel::lines(
            Axis::logarithmic("unknowns"),
            Axis::logarithmic("error of the steady sensitivity [(°/h)/(°C/min)]"),
            24.0,
            vec![
                series("twice the distance to the next finer mesh", 1, |(_, s, finer), _| SAFETY * (s - finer).abs()),
                series(&truth, 0, |(_, s, _), exact| (s - exact).abs()),
            ],
        )],
    }
}
