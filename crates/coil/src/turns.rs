//! Temperature and strain of the glass, turn by turn.

use bias::Slice;
use winding::Winding;

/// Temperature and strains of the glass at the centre of every turn, in the winding's order; or their rates \[…/s\].
#[derive(Debug, Clone, PartialEq)]
pub struct TurnValues {
    /// Temperature \[K or °C, as the drives\].
    pub temperature: Vec<f64>,
    /// Strain along the fibre: the coil's hoop strain.
    pub axial: Vec<f64>,
    /// Strain across the fibre: dehomogenised.
    pub radial: Vec<f64>,
    /// Temperature of the hub's bore, which the tails share.
    pub bore: f64,
}

impl TurnValues {
    /// Rates as slices for [`bias::bias`]: every turn, then the tails, which expand freely by `fibre_expansion` \[1/K\] at the bore's
    /// temperature.
    ///
    /// # Panics
    /// If `winding` has another number of turns.
    pub fn slices(&self, winding: &Winding, fibre_expansion: f64) -> Vec<Slice> {
        assert_eq!(winding.turns().len(), self.temperature.len(), "the winding these are the turns of");
        let turns = winding.turns().iter().enumerate().map(|(i, turn)| Slice {
            z_start: turn.z_start,
            z_end: turn.z_end,
            temperature_rate: self.temperature[i],
            axial_strain_rate: self.axial[i],
            radial_strain_rate: self.radial[i],
        });
        let (ccw, cw) = winding.tail_spans();
        let tails = [ccw, cw].into_iter().filter(|(start, end)| end > start).map(|(z_start, z_end)| Slice {
            z_start,
            z_end,
            temperature_rate: self.bore,
            axial_strain_rate: fibre_expansion * self.bore,
            radial_strain_rate: fibre_expansion * self.bore,
        });
        turns.chain(tails).collect()
    }
}
