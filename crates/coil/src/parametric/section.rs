//! The section of coil, spool and chamber as rectangles, which a changed design stretches.

use super::strip::Stretch;
use crate::layout::Skins;
use crate::{Design, Domain, Error, Layout, Region};

/// Lines of a section and the regions between them.
#[derive(Debug, Clone, PartialEq)]
#[cfg_attr(feature = "serde", derive(serde::Serialize, serde::Deserialize))]
pub(super) struct Section {
    /// Lines along r and along y, increasing \[m\].
    pub(super) lines: [Vec<f64>; 2],
    /// Region of each rectangle, r fastest; `None` where nothing is modelled.
    pub(super) regions: Vec<Option<Region>>,
}

/// Relative change of a radius at most: the series of 1/r leaves out its fourth power.
const MOST_MOVED: f64 = 0.02;

/// Error of a design whose section cannot be reached by stretching.
fn other_section(field: &str) -> Error {
    let problem = "this design has other parts or faces than the one that was modelled; model it anew";
    Error::design(field, problem.into())
}

impl Section {
    /// The section of `design`, with a skin at every bonded face.
    pub(super) fn new(design: &Design) -> Result<Self, Error> {
        let layout = Layout::with_skins(design, Skins::All)?;
        let domain = Domain::of_heat(design);
        let rectangles = || layout.solids.iter().chain((domain == Domain::Chamber).then_some(&layout.chamber));
        let lines = [
            crate::grid::distinct(rectangles().flat_map(|s| s.r).collect()),
            crate::grid::distinct(rectangles().flat_map(|s| s.y).collect()),
        ];
        let middle = |w: &[f64]| (w[0] + w[1]) / 2.0;
        let mut regions = Vec::new();
        for y in lines[1].windows(2).map(middle) {
            for r in lines[0].windows(2).map(middle) {
                regions.push(layout.region_in(domain, r, y));
            }
        }
        Ok(Self { lines, regions })
    }

    /// Number of strips along a direction.
    pub(super) fn strips(&self, direction: usize) -> usize {
        self.lines[direction].len() - 1
    }

    /// Rectangles: number of the strip along r and along y, and the region.
    pub(super) fn rectangles(&self) -> impl Iterator<Item = (usize, usize, Region)> + '_ {
        let columns = self.strips(0);
        self.regions.iter().enumerate().filter_map(move |(n, region)| region.map(|region| (n % columns, n / columns, region)))
    }

    /// The region of a rectangle, `None` beyond what is modelled.
    pub(super) fn region(&self, i: Option<usize>, j: Option<usize>) -> Option<Region> {
        let (i, j) = (i.filter(|i| *i < self.strips(0))?, j.filter(|j| *j < self.strips(1))?);
        self.regions[j * self.strips(0) + i]
    }

    /// Places of this section's strips in the section of a changed design: along r, along y.
    ///
    /// # Errors
    /// [`Error::Design`] if stretching does not get there, or the coil itself is changed.
    pub(super) fn stretched(&self, changed: &Section) -> Result<[Vec<Stretch>; 2], Error> {
        if self.regions != changed.regions || (0..2).any(|d| self.lines[d].len() != changed.lines[d].len()) {
            return Err(other_section("spool"));
        }
        let stretch = |d: usize| -> Vec<Stretch> {
            let pairs = self.lines[d].windows(2).zip(changed.lines[d].windows(2));
            pairs.map(|(from, to)| Stretch::between([from[0], from[1]], [to[0], to[1]])).collect()
        };
        let all = [stretch(0), stretch(1)];
        let coil = self.rectangles().find(|(.., region)| *region == Region::Coil);
        let still = Stretch { shift: 0.0, stretch: 1.0 };
        let moved = |i: usize| (0..2).map(|k| (changed.lines[0][i + k] / self.lines[0][i + k] - 1.0).abs()).fold(0.0, f64::max);
        if self.rectangles().any(|(i, _, region)| region != Region::Medium && moved(i) > MOST_MOVED) {
            let problem = format!(
                "a radius of the spool moves by more than {} %, more than was modelled; model it anew",
                100.0 * MOST_MOVED
            );
            return Err(Error::design("spool.hub_thickness", problem));
        }
        if coil.is_none_or(|(i, j, _)| all[0][i] != still || all[1][j] != still) {
            return Err(other_section("coil"));
        }
        Ok(all)
    }

    /// Place in this section of a point of a changed one.
    pub(super) fn reference(&self, changed: &Section, at: [f64; 2]) -> [f64; 2] {
        [0, 1].map(|d| {
            let (from, to) = (&changed.lines[d], &self.lines[d]);
            let k = from.partition_point(|line| *line <= at[d]).clamp(1, from.len() - 1) - 1;
            to[k] + (at[d] - from[k]) / (from[k + 1] - from[k]) * (to[k + 1] - to[k])
        })
    }
}
