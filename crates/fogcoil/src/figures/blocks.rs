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

/// Means over cells of half a pitch by a layer, larger where there are too many, or sums over blocks; equal cells that fill the winding.
pub(super) fn cells(winding: &Winding, values: &[f64], blocks: bool) -> Cells {
    let spec = winding.spec();
    let (height, pitch) = (winding.height(), spec.pitch);
    let (wanted, most_rows) = if blocks {
        ((height / (BLOCK as f64 * pitch)).round(), spec.layers.div_ceil(BLOCK))
    } else {
        ((height / (pitch / 2.0) - SLACK).ceil(), spec.layers)
    };
    let columns = (wanted.max(1.0) as usize).min(MOST_CELLS[0]);
    let width = height / columns as f64;
    let rows = most_rows.clamp(1, MOST_CELLS[1]);
    let (mut sums, mut counts) = (vec![0.0; rows * columns], vec![0.0; rows * columns]);
    for (turn, value) in winding.turns().iter().zip(values) {
        let row = (turn.layer - 1) * rows / spec.layers * columns;
        let (first, end) = if blocks {
            // a quarter of a pitch puts both kinds of layers well inside
            let column = (((turn.y - pitch / 4.0) / width).max(0.0) as usize).min(columns - 1);
            (column, column + 1)
        } else {
            let [first, end] = [-0.5, 0.5].map(|half| (((turn.y + half * pitch) / width).round().max(0.0) as usize).min(columns));
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
    Cells { columns, values, y: [0.0, height], r: [lower, lower + spec.layers as f64 * step] }
}

#[cfg(test)]
mod tests {
    use super::*;
    use winding::{ClimbSide, Pattern, Spec, Tails, TurnLength};

    #[test]
    fn blocks_lie_in_the_winding_and_keep_its_sum() {
        for (layers, odd) in [(36, 106), (8, 3), (4, 3), (40, 27)] {
            let spec = Spec {
                pattern: Pattern::PracticalQuadrupole,
                layers,
                turns_odd_layers: odd,
                turns_even_layers: odd - 1,
                inner_radius: 0.04,
                pitch: 1.7e-4,
                start: 0.0,
                end: None,
                cw_climbs: ClimbSide::Right,
                turn_length: TurnLength::True,
                tails: Tails { cw: 0.0, ccw: 0.0 },
                defect: None,
            };
            let winding = winding::wind(&spec).unwrap();
            let values: Vec<f64> = winding.turns().iter().map(|t| t.r + t.y).collect();
            let blocks = cells(&winding, &values, true);
            assert_eq!(blocks.y, [0.0, winding.height()]);
            assert!(blocks.r[0] >= spec.inner_radius && blocks.values.len() == layers / BLOCK * blocks.columns);
            let (sum, expected): (f64, f64) = (blocks.values.iter().sum(), values.iter().sum());
            assert!((sum / expected - 1.0).abs() < 1e-12, "{layers} layers: {sum} of {expected}");
            assert!(winding.turns().iter().all(|t| blocks.at([t.r, t.y]).is_finite()), "{layers} layers");
            assert!(blocks.at([0.0, 0.0]).is_nan() && blocks.at([blocks.r[0], 1.0]).is_nan());
        }
    }
}
