//! The section of coil and spool in time, for ParaView: a series of grids (`.pvd`, `.vtu`), a part for each solid and one for the turns.

use std::io;
use std::path::{Path, PathBuf};

use bias::Bias;
use coil::{Region, STANDARD, Section, SectionElement, SectionState};
use vtu::{Array, Entry, Grid, Series};
use winding::Half;

use crate::Error;
use crate::simulate::{Fields, MOST_FRAMES, Sample, Simulation};
use crate::turn_bias::Contributions;

/// The series' file in its folder.
const SERIES: &str = "section.pvd";
/// Names of the parts, the turns last.
const PARTS: [&str; 5] = ["coil", "hub", "left_flange", "right_flange", "turns"];
const TURNS: usize = PARTS.len() - 1;

/// The part that a region belongs to; the skins of contacts are the hub's and the flanges'.
fn part_of(region: Region) -> Option<usize> {
    match region {
        Region::Coil => Some(0),
        Region::Hub | Region::Contact => Some(1),
        Region::LeftFlange | Region::LeftContact => Some(2),
        Region::RightFlange | Region::RightContact => Some(3),
        Region::Medium => None,
    }
}

/// Every file that [`SectionFiles`] may write into `folder`.
pub fn possible(folder: &Path) -> Vec<PathBuf> {
    let parts = PARTS.iter().flat_map(|part| (0..MOST_FRAMES).map(move |frame| name(part, frame)));
    std::iter::once(SERIES.to_owned()).chain(parts).map(|name| folder.join(name)).collect()
}

fn name(part: &str, frame: usize) -> String {
    format!("{part}_{frame:02}.vtu")
}

/// The files of a simulation's section.
pub struct SectionFiles<'a> {
    simulation: &'a Simulation<'a>,
    fields: &'a Fields,
    section: Section<'a>,
    rest: Vec<f64>,
    parts: Vec<usize>,
}

/// A file: its name and its content.
pub struct File {
    /// Name in the folder.
    pub name: String,
    frame: Option<(usize, usize)>,
}

impl<'a> SectionFiles<'a> {
    /// The section of a simulation with its fields.
    ///
    /// # Errors
    /// [`files::Error::Coil`] if the design has no mesh, which one that was simulated has.
    pub fn new(simulation: &'a Simulation, fields: &'a Fields) -> Result<Self, Error> {
        let (case, profile) = (simulation.case, simulation.profile);
        let section = Section::new(&case.design, &STANDARD.resolution, &fields.section).map_err(Error::of_coil(&case.file))?;
        let has = |part: &usize| *part == TURNS || section.grid().regions().iter().any(|region| part_of(*region) == Some(*part));
        let parts = (0..PARTS.len()).filter(has).collect();
        Ok(Self { simulation, fields, section, rest: profile.profile.rest(&profile.drives), parts })
    }

    /// All files, the series first.
    pub fn files(&self) -> Vec<File> {
        let frames = 0..self.simulation.frames.len();
        let of = |frame: usize| {
            self.parts.iter().map(move |part| File { name: name(PARTS[*part], frame), frame: Some((frame, *part)) })
        };
        std::iter::once(File { name: SERIES.to_owned(), frame: None }).chain(frames.flat_map(of)).collect()
    }

    /// Writes one of the [`files`](Self::files).
    ///
    /// # Errors
    /// The error of the writer.
    pub fn write(&self, file: &File, out: &mut dyn io::Write) -> io::Result<()> {
        match file.frame {
            None => self.series().write(out),
            Some((frame, TURNS)) => self.turns(&self.simulation.frames[frame])?.write(out),
            Some((frame, part)) => solid(&self.state(&self.simulation.frames[frame]), part).write(out),
        }
    }

    fn series(&self) -> Series {
        let all = self.files();
        let entry = |file: &File| {
            let (frame, part) = file.frame?;
            let part = self.parts.iter().position(|p| *p == part)?;
            Some(Entry { time: self.simulation.frames[frame].time, part, file: file.name.clone() })
        };
        Series { entries: all.iter().filter_map(entry).collect() }
    }

    fn state(&self, sample: &Sample) -> SectionState<'_> {
        self.section.at(&sample.state, &self.rest)
    }

    /// The turns as rectangles of pitch by layer, with temperature and strain of the glass of each and its contribution to the bias.
    fn turns(&self, sample: &Sample) -> io::Result<Grid> {
        let (case, turns) = (self.simulation.case, self.simulation.case.winding.turns());
        let centres: Vec<[f64; 2]> = turns.iter().map(|turn| [turn.r, turn.y]).collect();
        let found = self.state(sample).at_places(&self.section.places(&centres));
        let value = |of: fn(&coil::PointValues) -> f64| found.iter().map(|at| at.as_ref().map_or(f64::NAN, of)).collect();
        let bias = Contributions::of(case, &self.fields.turns, &sample.change).map_err(io::Error::other)?;
        let pitch = case.winding.spec().pitch;
        let (high, wide) = (3_f64.sqrt() / 4.0 * pitch, pitch / 2.0);
        let corners = |[r, y]: &[f64; 2]| {
            [(-1.0, -1.0), (1.0, -1.0), (1.0, 1.0), (-1.0, 1.0)].map(|(a, b)| [r + a * high, y + b * wide, 0.0])
        };
        Ok(Grid {
            points: centres.iter().flat_map(corners).collect(),
            quadrilaterals: (0..turns.len()).map(|k| [0, 1, 2, 3].map(|corner| 4 * k + corner)).collect(),
            of_points: Vec::new(),
            of_cells: vec![
                Array::scalar("temperature_c", value(|at| at.temperature)),
                Array::scalar("glass_axial_strain", value(|at| at.strain[2])),
                Array::scalar("glass_radial_strain", value(|at| at.glass_radial)),
                Array::scalar("bias_deg_per_h", bias.part(Bias::total)),
                Array::scalar("shupe_deg_per_h", bias.part(|b| b.shupe)),
                Array::scalar("eo_axial_deg_per_h", bias.part(|b| b.eo_axial)),
                Array::scalar("eo_radial_deg_per_h", bias.part(|b| b.eo_radial)),
                Array::scalar("z_m", turns.iter().map(|t| (t.z_start + t.z_end) / 2.0).collect()),
                Array::whole("layer", turns.iter().map(|t| t.layer as i32).collect()),
                Array::whole("is_cw", turns.iter().map(|t| i32::from(t.half == Half::Cw)).collect()),
            ],
        })
    }
}

/// A solid's elements, each divided at its nodes; points of each apart, so that strains may jump.
fn solid(state: &SectionState, part: usize) -> Grid {
    let mut grid = Grid::default();
    let (mut temperature, mut displacement, mut strain, mut glass) = (Vec::new(), Vec::new(), Vec::new(), Vec::new());
    for SectionElement { points, values, .. } in state.elements().into_iter().filter(|e| part_of(e.region) == Some(part)) {
        let (first, n) = (grid.points.len(), points.len().isqrt());
        let corners = |k: usize| {
            let at = first + k / (n - 1) * n + k % (n - 1);
            [at, at + 1, at + 1 + n, at + n]
        };
        grid.quadrilaterals.extend((0..(n - 1) * (n - 1)).map(corners));
        grid.points.extend(points.iter().map(|[r, y]| [*r, *y, 0.0]));
        for at in &values {
            let ([u_r, u_y], [rr, yy, hoop, shear]) = (at.displacement, at.strain);
            temperature.push(at.temperature);
            displacement.extend([u_r, u_y, 0.0]);
            strain.extend([rr, yy, hoop, shear / 2.0, 0.0, 0.0]);
            glass.push(at.glass_radial);
        }
    }
    grid.of_points = vec![
        Array::scalar("temperature_c", temperature),
        Array::components("displacement_m", &["R", "Y", "HOOP"], displacement),
        Array::components("strain", &["RR", "YY", "HOOP", "RY", "Y_HOOP", "R_HOOP"], strain),
    ];
    if part == 0 {
        grid.of_points.push(Array::scalar("glass_radial_strain", glass));
    }
    grid
}
