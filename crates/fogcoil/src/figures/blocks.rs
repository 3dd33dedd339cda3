//! Values of turns over the cross-section: turn by turn, or summed over blocks.

use winding::Winding;

/// Layers and turns of a block: four layers are the period of a quadrupole, within which the weights nearly cancel.
pub(super) const BLOCK: usize = 4;
/// Most cells of a map along the axis and across the layers.
const MOST_CELLS: [usize; 2] = [440, 80];
/// A cell that would hold less than this part of its width is none.
const SLACK: f64 = 1e-6;

/// Values over the cross-section.
#[derive(Clone)]
pub(super) struct Cells {
    pub(super) columns: usize,
    /// Row by row from the inside; not a number where there is no turn.
    pub(super) values: Vec<f64>,
    /// Ends along the axis \[m\].
    pub(super) y: [f64; 2],
    /// Lower end of the first row, upper end of the last \[m\].
    pub(super) r: [f64; 2],
}

impl Cells {
    /// The value at a place of the section \[m\]; not a number outside.
    pub(super) fn at(&self, [r, y]: [f64; 2]) -> f64 {
        let rows = self.values.len() / self.columns.max(1);
        let index = |x: f64, [low, high]: [f64; 2], count: usize| {
            let place = (x - low) / (high - low) * count as f64;
            (0.0..=count as f64).contains(&place).then(|| (place as usize).min(count - 1))
        };
        let place = index(r, self.r, rows).zip(index(y, self.y, self.columns));
        place.map_or(f64::NAN, |(row, column)| self.values[row * self.columns + column])
    }
}

/// Means over cells of half a pitch by a layer, larger where there are too many, or sums over blocks; equal cells that fill the winding. Blocks
/// take the turns by their number within the layer, so that of each layer they hold the same, wherever it begins; the last ones may reach beyond the
/// last layer.
pub(super) fn cells(winding: &Winding, values: &[f64], blocks: bool) -> Cells {
    let spec = winding.spec();
    let (height, pitch, edges) = (winding.height(), spec.pitch, winding.edges());
    let most_turns = winding.turns().iter().map(|turn| turn.turn).max().unwrap_or(1);
    let (wanted, depth) = if blocks {
        ((most_turns + BLOCK / 2) / BLOCK, BLOCK * spec.layers.div_ceil(BLOCK * MOST_CELLS[1]))
    } else {
        ((height / (pitch / 2.0) - SLACK).ceil() as usize, spec.layers.div_ceil(MOST_CELLS[1]))
    };
    let columns = wanted.clamp(1, MOST_CELLS[0]);
    let width = height / columns as f64;
    let rows = spec.layers.div_ceil(depth);
    let (mut sums, mut counts) = (vec![0.0; rows * columns], vec![0.0; rows * columns]);
    for (turn, value) in winding.turns().iter().zip(values) {
        let row = (turn.layer - 1) / depth * columns;
        let (first, end) = if blocks {
            let column = (turn.turn - 1) * columns / most_turns;
            (column, column + 1)
        } else {
            let [first, end] =
                [-0.5, 0.5].map(|half| (((turn.y - edges[0] + half * pitch) / width).round().max(0.0) as usize).min(columns));
            (first.min(columns - 1), end.max(first + 1).min(columns))
        };
        for column in first..end {
            sums[row + column] += value;
            counts[row + column] += 1.0;
        }
    }
    // a place without a turn is 0/0, not a number
    let cell = |(sum, count): (&f64, &f64)| if blocks && *count > 0.0 { *sum } else { sum / count };
    let values = sums.iter().zip(&counts).map(cell).collect();
    let step = 3_f64.sqrt() / 2.0 * pitch;
    let lower = spec.inner_radius + (pitch - step) / 2.0;
    Cells { columns, values, y: edges, r: [lower, lower + (rows * depth) as f64 * step] }
}

#[cfg(test)]
mod tests {
    use super::*;
    use winding::{ClimbSide, Half, Pattern, Spec, Tails, TurnLength};

    fn wound(pattern: Pattern, layers: usize, turns: [usize; 2]) -> Winding {
        wound_from(0.0, pattern, layers, turns)
    }

    fn wound_from(start: f64, pattern: Pattern, layers: usize, [odd, even]: [usize; 2]) -> Winding {
        winding::wind(&Spec {
            pattern,
            layers,
            turns_odd_layers: odd,
            turns_even_layers: even,
            inner_radius: 0.04,
            pitch: 1.7e-4,
            start,
            end: None,
            cw_climbs: ClimbSide::Right,
            turn_length: TurnLength::True,
            tails: Tails { cw: 0.0, ccw: 0.0 },
            defect: None,
        })
        .unwrap()
    }

    #[test]
    fn blocks_lie_in_the_winding_and_keep_its_sum() {
        for (layers, odd, start) in [(36, 106, 0.0), (8, 3, 0.0), (4, 3, 2e-3), (40, 27, 2e-3), (30, 41, 0.0), (500, 5, 0.0)] {
            let winding = wound_from(start, Pattern::PracticalQuadrupole, layers, [odd, odd - 1]);
            let values: Vec<f64> = winding.turns().iter().map(|t| t.r + t.y).collect();
            let blocks = cells(&winding, &values, true);
            assert_eq!(blocks.y, winding.edges());
            assert!(blocks.r[0] >= winding.spec().inner_radius && blocks.values.len().is_multiple_of(blocks.columns));
            let (sum, expected): (f64, f64) = (blocks.values.iter().sum(), values.iter().sum());
            assert!((sum / expected - 1.0).abs() < 1e-12, "{layers} layers: {sum} of {expected}");
            assert!(winding.turns().iter().all(|t| blocks.at([t.r, t.y]).is_finite()), "{layers} layers");
            assert!(blocks.at([0.0, 0.0]).is_nan() && blocks.at([blocks.r[0], 1.0]).is_nan());
        }
    }

    #[test]
    fn a_block_holds_as_many_turns_of_either_half() {
        for (turns, layers) in [([40, 40], 32), ([41, 41], 32), ([40, 39], 32), ([106, 105], 36), ([40, 40], 30)] {
            for pattern in [Pattern::Octupole, Pattern::Quadrupole] {
                let winding = wound(pattern, layers, turns);
                let of = |half: Half| {
                    let own: Vec<f64> = winding.turns().iter().map(|t| f64::from(u8::from(t.half == half))).collect();
                    cells(&winding, &own, true)
                };
                let [cw, ccw] = [Half::Cw, Half::Ccw].map(of);
                // an unfinished period at the outside is of its own
                let full = layers / BLOCK * cw.columns;
                assert_eq!(cw.values[..full], ccw.values[..full], "{pattern:?}, {layers} layers, {turns:?} turns");
                let whole = |turns: usize| turns.is_multiple_of(BLOCK);
                let sizes = cw.values[..full].iter().map(|count| 2.0 * count);
                assert!(sizes.into_iter().all(|size| if turns.into_iter().all(whole) {
                    size == 16.0
                } else {
                    (10.0..=20.0).contains(&size)
                }));
            }
        }
    }
}
