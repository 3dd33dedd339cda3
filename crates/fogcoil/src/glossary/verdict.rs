//! Verdicts of a diagnosis, and the state of a question that no record answers: meaning and next step.

/// A verdict, in words.
#[derive(Debug, Clone, Copy)]
pub struct Verdict {
    /// Its id.
    pub id: &'static str,
    /// Its meaning.
    pub meaning: &'static str,
    /// Its limits: a conclusion that it does not support.
    pub limits: &'static str,
    /// The next step.
    pub next: &'static str,
}

/// All of them.
pub const VERDICTS: [Verdict; 5] = [
    Verdict {
        id: "none",
        meaning: "The design as it is predicts the record: the difference is noise, and nothing is left out.",
        limits: "An effect that is smaller than the noise, or that this profile does not excite, does not show.",
        next: "Compare the smallest effect that the record shows with your specification. Give a record that was held out (--holdout), under another profile.",
    },
    Verdict {
        id: "recalibrate",
        meaning: "Constants of the design, or the instruments, within their tolerances explain the record; no fault is needed.",
        limits: "This is no certificate: a small fault hides among the tolerances. Look at the probability; below 0.8 the verdict is doubtful.",
        next: "Narrow the tolerances: calibrate the lot from good units (fogcoil calibrate), diagnose with the lot's design, and give a held-out record of each unit.",
    },
    Verdict {
        id: "explained",
        meaning: "A mechanism with a name explains the record better than the design, its constants and everything without a name.",
        limits: "The set holds every id that the records do not exclude; the first is the likeliest, not the only one.",
        next: "If the set has more than one id, find the test that tells them apart (fogcoil recommend), or make the inspection of the unit that the answer names.",
    },
    Verdict {
        id: "unknown",
        meaning: "The record differs from the design by more than noise, and no mechanism with a name explains the difference better than the rest.",
        limits: "The nearest named mechanism and a composed law are hints: they predict, they do not say why.",
        next: "Check the record (fogcoil check: units, signs, columns, rest at the start), then the design and its tolerances. Ask for mechanisms that are weighed on request (--mechanism ID; fogcoil explain lists them). Repeat the test under another profile: what does not return belongs to the time, not to the temperature.",
    },
    Verdict {
        id: "inseparable",
        meaning: "Two or more candidates predict nearly the same record under every profile within the limits.",
        limits: "More data of the same kind does not help; the best profile is the best of the insufficient ones.",
        next: "Widen the limits of the chamber (fogcoil recommend --coldest, --hottest, --fastest, --hours), add the sensor that recommend names, or inspect the unit itself.",
    },
];

/// The verdict of an id.
pub(super) fn find(id: &str) -> Option<&'static Verdict> {
    VERDICTS.iter().find(|verdict| verdict.id == id)
}
