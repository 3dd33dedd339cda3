//! Residuals of a study, before and after, as pictures.

use super::chart::{Chart, Line};
use super::plant::Plant;
use super::study::{Error, Records, Study};
use diagnosis::{ForwardModel, Observation};

/// Points of a line at most.
const POINTS: usize = 400;

/// Residual of a channel in every record, one behind another: recorded less predicted.
type Left = Vec<Vec<f64>>;

/// By the nominal model and with the laws that are borne out, of the records in the order fitted, then held out.
pub(crate) fn left<P: Plant>(
    study: &Study<P>,
    recorded: &[Observation],
    records: &Records<'_>,
    channel: usize,
) -> Result<[Left; 2], Error> {
    let best = study.accepted.as_ref().map_or(&study.nominal, |(fit, _)| fit);
    let mut both = [Vec::new(), Vec::new()];
    for (left, fit) in both.iter_mut().zip([&study.nominal, best]) {
        left.extend(records.fitted.iter().enumerate().map(|(k, _)| fit.residuals[k][channel].clone()));
        for held in records.held {
            let prediction = fit.hold_out(&study.model, *held, &recorded[*held], fit)?.prediction;
            let mut own: Vec<f64> =
                recorded[*held].channels[channel].iter().zip(&prediction[channel]).map(|(y, p)| y - p).collect();
            if study.model.channels()[channel].offset.1.is_infinite() {
                let mean = own.iter().sum::<f64>() / own.len() as f64;
                own.iter_mut().for_each(|r| *r -= mean);
            }
            left.push(own);
        }
    }
    Ok(both)
}

/// The same over time, the records side by side; those held out are set off. `names` are those of the records that were held out.
pub(crate) fn over_time<P: Plant>(
    study: &Study<P>,
    recorded: &[Observation],
    records: &Records<'_>,
    channel: usize,
    title: &str,
    names: &[&str],
) -> Result<Chart, Error> {
    let all: Vec<usize> = records.fitted.iter().chain(records.held).copied().collect();
    let spans: Vec<f64> =
        all.iter().map(|r| recorded[*r].time.last().zip(recorded[*r].time.first()).map_or(0.0, |(b, a)| b - a)).collect();
    let starts: Vec<f64> = spans.iter().scan(0.0, |sum, span| Some(std::mem::replace(sum, *sum + span))).collect();
    let line = |name: &'static str, left: &Left| {
        let points = all.iter().zip(left).zip(&starts).flat_map(|((r, left), start)| {
            let own = &recorded[*r].time;
            own.iter().zip(left).map(move |(t, y)| [start + t - own[0], *y])
        });
        Line { name, points: thinned(&points.collect::<Vec<_>>()) }
    };
    let [before, after] = left(study, recorded, records, channel)?;
    let shade = |(k, name): (usize, &&str)| {
        let at = records.fitted.len() + k;
        ([starts[at], starts[at] + spans[at]], format!("held out: {name}"))
    };
    let own = &study.model.channels()[channel];
    Ok(Chart {
        title: title.to_owned(),
        across: "time, the records one behind another [s]".into(),
        up: format!("{} less predicted [{}]", own.name, own.unit),
        lines: vec![line("by the nominal model", &before), line("with what was found", &after)],
        shades: names.iter().enumerate().map(shade).collect(),
    })
}

/// Means of neighbours, so that few enough are left.
fn thinned(points: &[[f64; 2]]) -> Vec<[f64; 2]> {
    let mean = |chunk: &[[f64; 2]]| [0, 1].map(|k| chunk.iter().map(|p| p[k]).sum::<f64>() / chunk.len() as f64);
    points.chunks(points.len().div_ceil(POINTS).max(1)).map(mean).collect()
}

/// Writes a picture into the folder that follows `--pictures` among the program's arguments, if there is one.
pub(crate) fn write(name: &str, chart: &Chart) -> std::io::Result<()> {
    let mut arguments = std::env::args().skip_while(|a| a != "--pictures").skip(1);
    match arguments.next() {
        Some(folder) => std::fs::write(std::path::Path::new(&folder).join(name), chart.svg()),
        None => Ok(()),
    }
}
