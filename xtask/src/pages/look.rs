//! A page as a reader has it: its width, light or dark, on paper; what a browser and axe-core find there.

use std::fs;
use std::path::Path;

use base64::Engine;
use base64::engine::general_purpose::STANDARD;
use serde::Deserialize;
use serde_json::json;

use crate::browser::{Browser, complaint, request};
use proof::Failure;

/// Widths of a phone, a tablet and a screen [CSS px].
pub(super) const WIDTHS: [u32; 3] = [360, 768, 1280];
/// Highest screenshot [CSS px].
const MOST_HIGH: u64 = 16_000;
/// Smallest letters of a figure [CSS px].
const LEAST_LETTER: f64 = 9.0;
const CHECK: &str = include_str!("look.js");

/// A reader's preferred colour schemes, as CSS names them.
pub(super) const THEMES: [&str; 2] = ["light", "dark"];

#[derive(Debug, Clone, Deserialize)]
pub(super) struct Finding {
    pub(super) id: String,
    /// minor, moderate, serious or critical.
    pub(super) impact: Option<String>,
    pub(super) nodes: usize,
    help: String,
    first: String,
}

impl Finding {
    pub(super) fn grave(&self) -> bool {
        matches!(self.impact.as_deref(), Some("serious" | "critical"))
    }
}

#[derive(Debug, Clone, Deserialize)]
struct Said {
    inner: u32,
    height: u64,
    overflow: Vec<String>,
    clipped: Vec<String>,
    overlapping: Vec<String>,
    smallest: f64,
    axe: String,
    findings: Vec<Finding>,
}

/// Findings on a page at a width in a theme.
pub(super) struct Look {
    pub(super) page: String,
    pub(super) width: u32,
    pub(super) theme: &'static str,
    pub(super) findings: Vec<Finding>,
    /// Elements wider than the page.
    pub(super) overflow: Vec<String>,
    /// Labels that leave their figure or cover one another.
    pub(super) labels: Vec<String>,
    /// Errors and warnings.
    pub(super) console: Vec<String>,
    /// Requests to the network or the disk besides the page.
    pub(super) requests: Vec<String>,
    pub(super) axe: String,
}

impl Look {
    /// Whether there is nothing for which the page is turned down.
    pub(super) fn holds(&self) -> bool {
        let rest = [&self.overflow, &self.labels, &self.console, &self.requests];
        rest.iter().all(|all| all.is_empty()) && !self.findings.iter().any(Finding::grave)
    }

    pub(super) fn faults(&self) -> Vec<String> {
        let finding = |f: &Finding| {
            format!("axe: {} ({}, {} nodes, first {}): {}", f.id, f.impact.as_deref().unwrap_or("?"), f.nodes, f.first, f.help)
        };
        let of = |what: &'static str, all: &[String]| all.iter().map(|one| format!("{what}: {one}")).collect::<Vec<_>>();
        let mut faults: Vec<String> = self.findings.iter().map(finding).collect();
        faults.extend(of("wider than the page", &self.overflow));
        faults.extend(of("label", &self.labels));
        faults.extend(of("console", &self.console));
        faults.extend(of("request", &self.requests));
        faults
    }
}

/// Opens `file`, judges it, and keeps a screenshot in `folder`.
pub(super) fn look(
    browser: &mut Browser,
    axe: &str,
    file: &Path,
    width: u32,
    theme: &'static str,
    folder: &Path,
) -> Result<Look, Failure> {
    let page = file.file_stem().unwrap_or_default().to_string_lossy().into_owned();
    let url = format!("file://{}", file.display());
    resize(browser, width, 900)?;
    let scheme = json!({ "name": "prefers-color-scheme", "value": theme });
    browser.call("Emulation.setEmulatedMedia", json!({ "media": "screen", "features": [scheme] }))?;
    browser.open(&url)?;
    browser.evaluate(axe)?;
    let said: Said = serde_json::from_value(browser.evaluate(CHECK)?)?;
    if said.inner != width {
        return Err(Failure(format!("{page}: Chromium shows {} px where {width} px were asked for", said.inner)));
    }
    let events = browser.events();
    resize(browser, width, said.height.min(MOST_HIGH) as u32)?;
    let shot = browser.call("Page.captureScreenshot", json!({ "format": "png" }))?;
    let name = format!("{page}-{width}-{}.png", theme);
    fs::write(folder.join(name), decoded(shot["data"].as_str().unwrap_or_default())?)?;
    let small =
        (said.smallest > 0.0 && said.smallest < LEAST_LETTER).then(|| format!("letters of {:.1} px in a figure", said.smallest));
    let covered = said.overlapping.into_iter().map(|label| format!("covers another: {label}"));
    let labels = said.clipped.into_iter().map(|label| format!("leaves its figure: {label}")).chain(covered).chain(small);
    Ok(Look {
        page,
        width,
        theme,
        findings: said.findings,
        overflow: said.overflow,
        labels: labels.collect(),
        console: events.iter().filter_map(complaint).collect(),
        requests: events.iter().filter_map(request).filter(|to| *to != url).collect(),
        axe: said.axe,
    })
}

/// Prints `file` on A4 into `folder`.
pub(super) fn print(browser: &mut Browser, file: &Path, folder: &Path) -> Result<(), Failure> {
    let page = file.file_stem().unwrap_or_default().to_string_lossy().into_owned();
    browser.call("Emulation.setEmulatedMedia", json!({ "media": "", "features": [] }))?;
    browser.open(&format!("file://{}", file.display()))?;
    let margins = json!({ "paperWidth": 8.27, "paperHeight": 11.69, "printBackground": true });
    let printed = browser.call("Page.printToPDF", margins)?;
    fs::write(folder.join(format!("{page}.pdf")), decoded(printed["data"].as_str().unwrap_or_default())?)?;
    Ok(())
}

fn resize(browser: &mut Browser, width: u32, height: u32) -> Result<(), Failure> {
    let metrics = json!({ "width": width, "height": height, "deviceScaleFactor": 1, "mobile": false });
    browser.call("Emulation.setDeviceMetricsOverride", metrics).map(drop)
}

/// Bytes of a picture or a page.
fn decoded(base64: &str) -> Result<Vec<u8>, Failure> {
    STANDARD.decode(base64).map_err(|error| Failure(format!("Chromium's answer is no base64: {error}")))
}
