//! `fogcoil simulate`: its arguments, and the files that it writes.

use std::io::Write;
use std::path::{Path, PathBuf};

use clap::{ArgGroup, Args};
use coil::Drive;
use fogcoil::cache::Cache;
use fogcoil::input::{self, Between, CoilCase, ProfileCase, RecordOptions};
use fogcoil::output::{self, Content};
use fogcoil::section_files::{self, SectionFiles};
use fogcoil::simulate::{self, Fields, Model, Simulation};
use fogcoil::{Error, band, figures, report, summary};

use crate::cli_under::{self, divide, step};
use crate::progress::Progress;
use crate::{line, print};

#[derive(Args)]
#[command(group(ArgGroup::new("drive").required(true).args(["profile", "record", "spool"])))]
pub(crate) struct Simulate {
    /// Case file of the coil
    #[arg(value_name = "COIL.ron")]
    coil: PathBuf,
    /// Profile: time_s,chamber_c and, where wanted, left_c, right_c, mount_left_c, mount_right_c
    #[arg(long, value_name = "P.csv")]
    profile: Option<PathBuf>,
    /// In place of a profile: a recording, whose chamber drives the coil and whose thermometer and rate stand beside the result; read as `fogcoil check`
    /// reads it, with RECORD.map.ron beside it if it is there
    #[arg(long, value_name = "RECORD.csv", conflicts_with = "step")]
    record: Option<PathBuf>,
    /// A file that says how that recording is read, in place of one beside it, or how the profile is read: names and units of time and chamber, separator,
    /// decimal comma
    #[arg(long, value_name = "FILE.ron")]
    map: Option<PathBuf>,
    /// Course of the temperatures between the profile's rows
    #[arg(long, value_enum, default_value_t = Between::Linear, conflicts_with = "spool")]
    between: Between,
    /// Add a row every S seconds from the first row, on the straight lines between the profile's own
    #[arg(long, value_name = "S", value_parser = step, conflicts_with = "spool")]
    step: Option<f64>,
    /// In place of a profile: a record time_s,spool_c of the spool's thermometer, from rest, to infer the chamber from; with a map file, given or beside it, a
    /// recording, read as that of --record
    #[arg(long, value_name = "RECORD.csv")]
    spool: Option<PathBuf>,
    /// Standard deviation of the record's readings in K, rounding included
    #[arg(long, value_name = "K", conflicts_with = "profile", value_parser = noise, default_value = "0.01")]
    spool_noise: f64,
    /// A mechanism of your own that is at work, its parameters with values; may be given more than once
    #[arg(long = "mechanism", value_name = "MECHANISM.ron")]
    mechanisms: Vec<PathBuf>,
    /// Write the result here, a row for each of the profile's (and of --step)
    #[arg(long, value_name = "B.csv")]
    out: PathBuf,
    /// Write a page with plots here
    #[arg(long, value_name = "R.html")]
    report: Option<PathBuf>,
    /// Write the section of coil and spool in time into this folder, for ParaView: temperature, displacement, strain, and the turns' bias
    #[arg(long, value_name = "DIR")]
    vtu: Option<PathBuf>,
    /// Write rate and thermometer with one standard deviation by the design's tolerances here, and tell which tolerance matters
    #[arg(long, value_name = "BAND.csv")]
    band: Option<PathBuf>,
    /// Print the summary as one JSON object
    #[arg(long)]
    json: bool,
    /// Build the model anew and do not keep it ($FOGCOIL_CACHE, else $XDG_CACHE_HOME/fogcoil, else ~/.cache/fogcoil)
    #[arg(long)]
    no_cache: bool,
}

/// Largest noise \[K\] of a thermometer that is of use.
const MOST_NOISE: f64 = 10.0;

fn noise(text: &str) -> Result<f64, String> {
    let least = coil::LEAST_NOISE;
    let number = text.parse().ok().filter(|noise| (least..=MOST_NOISE).contains(noise));
    number.ok_or_else(|| format!("give kelvins from {least} to {MOST_NOISE}"))
}

pub(crate) fn run(arguments: &Simulate, progress: &Progress) -> Result<(), Error> {
    let Simulate { coil, profile, record, map, spool, mechanisms, out, report, vtu, band, json, no_cache, .. } = arguments;
    let own = input::read_simulated(mechanisms)?;
    let recorded = record.iter().chain(spool).flat_map(|path| arguments.reading(&[]).files(path));
    let mapped = map.as_ref().filter(|_| profile.is_some());
    let given = [profile.as_ref(), mapped].into_iter().flatten();
    let inputs: Vec<PathBuf> = given.chain(mechanisms).cloned().chain(recorded).collect();
    let section = vtu.as_deref().map_or(Vec::new(), places);
    let mut outputs = vec![Some(out.as_path()), report.as_deref(), band.as_deref()];
    outputs.extend(section.iter().map(|path| Some(path.as_path())));
    let case = progress.read_coil_for(coil, &inputs, &outputs)?;
    arguments.require_drawable(&case)?;
    let cache = if *no_cache { Cache::NONE } else { Cache::of_user() };
    let (profile, (model, fields)) = arguments.driven(&case, &input::further_columns(&own), &cache, progress)?;
    progress.tell(&profile.notes);
    let task = format!("simulating {} rows", profile.profile.time.len());
    let mut simulation = progress.during(&task, || simulate::simulate(&case, &profile, &model))?;
    progress.tasks(|tell| simulation.add(&own, &cache, tell))?;
    progress.tell(simulation.warning().as_slice());
    let within = band.as_ref().map(|_| progress.tasks(|tell| band::band(&simulation, &cache, tell))).transpose()?;
    arguments.save(&simulation, fields.as_ref(), within.as_ref(), &cache, progress)?;
    let mut object = summary::json(&simulation);
    object["tolerances"] = within.as_ref().map_or(serde_json::Value::Null, band::CourseBand::json);
    let told = within.as_ref().map_or(String::new(), band::CourseBand::text);
    print(&if *json { line(&object) } else { summary::text(&simulation) + &told })
}

/// Files that may be written in the folder of a section; the folder itself if it is still to be made.
fn places(folder: &Path) -> Vec<PathBuf> {
    if folder.is_dir() { section_files::possible(folder) } else { vec![folder.to_owned()] }
}

impl Simulate {
    /// Options for reading the recording, with these columns beside the usual ones.
    fn reading(&self, further: &[String]) -> RecordOptions {
        RecordOptions { map: self.map.clone(), further: further.to_vec(), ..RecordOptions::default() }
    }

    /// Refuses a coil of too many turns where its fields are asked for as files.
    fn require_drawable(&self, case: &CoilCase) -> Result<(), Error> {
        let (turns, most) = (case.winding.turns().len(), figures::MOST_TURNS);
        match self.vtu {
            Some(_) if turns > most => Err(Error::usage(format!(
                "--vtu: the coil has {turns} turns, and fields are kept of at most {most}; leave --vtu out"
            ))),
            _ => Ok(()),
        }
    }

    /// The profile, given or inferred, and the coil's model for its drives; with fields where they are to be drawn.
    fn driven(
        &self,
        case: &CoilCase,
        further: &[String],
        cache: &Cache,
        progress: &Progress,
    ) -> Result<(ProfileCase, (Model, Option<Fields>)), Error> {
        let drawn = (self.report.is_some() || self.vtu.is_some()) && case.winding.turns().len() <= figures::MOST_TURNS;
        let model = |drives: &[Drive]| {
            progress.during("modelling the coil", || match drawn {
                true => simulate::model_with_fields(case, drives, cache).map(|(model, fields)| (model, Some(fields))),
                false => simulate::model(case, drives, cache).map(|model| (model, None)),
            })
        };
        let reading = |path: &Path| format!("reading {}", files::shown_path(path));
        match (&self.profile, &self.spool) {
            (_, Some(spool)) => {
                let record = progress.during(&reading(spool), || input::read_spool(spool, &self.reading(&[]), &case.design))?;
                let modelled = model(&record.drives)?;
                let inferred =
                    progress.during("inferring the chamber", || simulate::infer(record, self.spool_noise, &modelled.0))?;
                Ok((inferred, modelled))
            }
            (Some(path), None) => {
                let profile = progress.during(&reading(path), || cli_under::profile(path, self.map.as_deref(), case, further))?;
                let profile = self.divided(profile)?;
                let modelled = model(&profile.drives)?;
                Ok((profile, modelled))
            }
            (None, None) => {
                let path = self.record.as_deref().ok_or_else(|| Error::usage("give --profile, --record or --spool"))?;
                let options = self.reading(further);
                let record = progress.during(&reading(path), || input::read_recorded(path, &options, &case.design))?;
                let record = self.divided(record)?;
                let modelled = model(&record.drives)?;
                Ok((record, modelled))
            }
        }
    }

    /// The profile with the rows that --step adds.
    fn divided(&self, mut profile: ProfileCase) -> Result<ProfileCase, Error> {
        profile.between = self.between;
        match (self.step, self.between) {
            (Some(_), Between::Cubic) => {
                return Err(Error::usage("--step adds rows on straight lines: it does not go with --between cubic"));
            }
            (None, Between::Cubic) => profile.note_long_rows("give the profile closer rows"),
            (step, Between::Linear) => divide(&mut profile, step)?,
        }
        Ok(profile)
    }

    /// Writes all files that are asked for.
    fn save(
        &self,
        simulation: &Simulation,
        fields: Option<&Fields>,
        within: Option<&band::CourseBand>,
        cache: &Cache,
        progress: &Progress,
    ) -> Result<(), Error> {
        let rows = |out: &mut dyn Write| simulation.write_csv(out);
        let bands = |out: &mut dyn Write| within.iter().try_for_each(|within| within.write_csv(out));
        let mut files = vec![(self.out.as_path(), Content::Written(&rows))];
        files.extend(self.band.as_deref().map(|path| (path, Content::Written(&bands))));
        if let Some(path) = &self.report {
            let measured =
                progress.during("solving on finer meshes", || figures::Convergence::measure(simulation.case, cache))?;
            files.push((path, Content::Text(report::html(simulation, fields, Some(&measured), within))));
        }
        let section = self.vtu.as_deref().zip(fields);
        let section =
            section.map(|(folder, fields)| Ok::<_, Error>((folder, SectionFiles::new(simulation, fields)?))).transpose()?;
        let listed: Vec<_> = section
            .iter()
            .flat_map(|(folder, all)| all.files().into_iter().map(move |f| (folder.join(&f.name), f, all)))
            .collect();
        let writers: Vec<_> = listed.iter().map(|(_, file, all)| move |out: &mut dyn Write| all.write(file, out)).collect();
        files.extend(listed.iter().zip(&writers).map(|((path, ..), write)| (path.as_path(), Content::Written(write))));
        if let Some((folder, _)) = &section {
            output::make_folder(folder)?;
        }
        progress.during(&format!("writing {}", files::shown_path(&self.out)), || progress.save(&files))
    }
}
