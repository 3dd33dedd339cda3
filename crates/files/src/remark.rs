//! Kinds of warnings and notes: each has an id that never changes, and an explanation.

use recording::check::FindingKind;

/// Cause, consequence and remedy of a remark: the columns of the table below.
#[derive(Debug, Clone, Copy, PartialEq, Eq)]
pub struct Explanation {
    /// Condition under which the program gives it.
    pub cause: &'static str,
    /// Its effect on the result.
    pub consequence: &'static str,
    /// The remedy.
    pub remedy: &'static str,
}

/// One table: an id cannot be printed without a row, and a row cannot lack a part.
macro_rules! remarks {
    ($($name:ident $id:literal: $cause:literal, $consequence:literal, $remedy:literal;)*) => {
        /// A kind of warning or note; the printed text ends in its id in brackets.
        #[derive(Debug, Clone, Copy, PartialEq, Eq, Hash)]
        pub enum Remark { $(#[doc = $cause] $name,)* }

        impl Remark {
            /// All of them.
            pub const ALL: &[Self] = &[$(Self::$name,)*];

            /// Its id, in kebab-case.
            pub fn id(self) -> &'static str {
                match self { $(Self::$name => $id,)* }
            }

            /// Cause, consequence and remedy.
            pub fn explanation(self) -> Explanation {
                match self { $(Self::$name => Explanation { cause: $cause, consequence: $consequence, remedy: $remedy },)* }
            }
        }
    };
}

remarks! {
    // coil files
    UnfilledCoil "unfilled-coil":
        "The coil's rectangle (`coil.outer_radius_mm`, `coil.height_mm`) is larger than the winding in it: by more than a pitch in radius, or a tenth of one in height.",
        "Heat flow and stiffness are those of the rectangle, all of it winding; the Sagnac diameter, unless given, is the mean one of the turns alone where the room in radius is more than a pitch. Turns begin at the left face: room at the right changes the sensitivity.",
        "Check layers, turns and `pitch_mm` against the drawing, or reduce the rectangle to the winding. A coil that is potted beyond its turns on purpose needs no change in radius: ignore the warning; in height, give `winding.start_mm` and `end_mm`.";
    OtherSpacing "other-spacing":
        "`winding.start_mm` and `end_mm` set the turns of a layer more than 3 % closer or farther apart than `pitch_mm`.",
        "Closer turns than a pitch do not fit between the ends; farther ones leave gaps of adhesive. The sensitivity follows the ends: some per cent for a tenth of a turn.",
        "Check both ends, the number of turns and `pitch_mm` against the winding record.";
    TurnOutside "turn-outside":
        "`winding.start_mm` or `end_mm` puts the outermost turns of a layer in part outside the coil's height.",
        "That part of the fibre is taken to be in the flange or the medium beside the coil, in temperature and in strain: the sensitivity changes at once.",
        "Check both ends and `coil.height_mm`: the edges of the turns lie from 0 to the height.";
    SagnacOutside "sagnac-outside":
        "`optics.sagnac_diameter_mm` lies outside the coil, from its inner to its outer diameter.",
        "Every rate is inversely proportional to it.",
        "Give the mean diameter of the turns in mm (not the radius, and not in metres).";
    SagnacDiffers "sagnac-differs":
        "`optics.sagnac_diameter_mm` is more than 2 % off the mean diameter: of the coil, or of the turns where the coil reaches more than a pitch beyond them (`unfilled-coil`).",
        "Every rate is inversely proportional to it.",
        "Leave it out: then it is that mean diameter. Give another only if it was measured.";
    LongTail "long-tail":
        "A tail in `winding.tails_m` is longer than half the winding.",
        "The middle of the fibre moves into one half of the coil: the sensitivity is that of a coil that is not symmetric at all.",
        "Tails are in metres; give the length of bare fibre beyond the last turn.";
    ModulusRatio "modulus-ratio":
        "In `coil.material` e_r is less than a ten-thousandth of e_z; potted coils have about a hundredth.",
        "The strain across the fibre, and with it the radial elasto-optic part, is far off.",
        "e_z is in GPa, e_r and g_zr are in MPa.";
    OtherPitch "other-pitch":
        "The cell that `FromCell` names has another pitch than the winding.",
        "Stiffness and expansion are those of a coil wound more closely or more loosely than this one: the sensitivity may change by half.",
        "Make the cell's `pitch_um` and the coil's `winding.pitch_mm` the same distance between neighbouring turns.";
    OtherCell "other-cell":
        "`coil.material` and `dehomogenization` name different cells by `FromCell`.",
        "The strain in the fibre is that of another cell than the winding's stiffness and expansion: the sensitivity is no coil's.",
        "Name one cell in both; in a plan vary both under one key, `coil.material and dehomogenization`.";
    OtherMass "other-mass":
        "The cell that `FromCell` names gives another density or specific heat than `coil` by more than the tolerance of that number.",
        "Heat flows through the coil as `coil` says, and its stiffness is the cell's: one of the two is another winding's, or in another unit.",
        "Take what `fogcoil homogenize` prints of the cell, or give the number a wider tolerance.";
    CutTolerance "cut-tolerance":
        "`tolerances` gives a start or an end of the winding more than a quarter of the distance from the outermost turn's centre to the coil's face there.",
        "That quarter is taken: four standard deviations take no turn's centre out of the coil. Bands and diagnoses count no more.",
        "Nothing if the turns fill the coil: they cannot lie elsewhere. Else check both ends and `coil.height_mm`.";
    UntoldMaterial "untold-material":
        "Of a cell's materials some have a density or a specific heat, and others have none.",
        "The cell has no mean of it: it is left out of the constants.",
        "Give it to the materials that are named, or to none.";
    BrokenPattern "broken-pattern":
        "The number of layers is no multiple of the pattern's period: 2 of a dipole, 4 of a quadrupole, 8 of an octupole.",
        "The two halves of the fibre are not balanced; the sensitivity may be several times as large.",
        "Check `winding.layers` against the winding programme.";
    SensorInMedium "sensor-in-medium":
        "The thermometer is neither on the spool nor in the coil, but in the medium around them.",
        "It reads the medium there, which follows the chamber faster than the spool does.",
        "Give the place on the part that it is fixed to; after a change of the hub's thickness the bore is elsewhere.";
    AnisotropicCell "anisotropic-cell":
        "The cell that `FromCell` names is not isotropic across the fibre, as a coil's law is; the message says by how much strain energy.",
        "Its mean over all turns about the fibre is taken: right for a coil in which the cell's orientation varies.",
        "Nothing at some per cent; else take a cell of more fibres, or give the constants themselves.";
    // profiles and thermometers' records
    IgnoredColumn "ignored-column":
        "A file has columns that are not read.",
        "None, unless one of them was meant: then its name is not the one that is sought.",
        "Rename it (profiles: time_s, chamber_c, left_c, right_c, mount_left_c, mount_right_c), or give --column KEY=NAME for a recording, --map FILE.ron for a profile.";
    CloseRows "close-rows":
        "Rows of a profile lie closer together than the model resolves a jump.",
        "Means over such intervals are not reliable just after the chamber's temperature changes suddenly.",
        "Thin the profile out, or let the temperature change over some seconds.";
    LongRows "long-rows":
        "Rows of a profile last longer than a coil takes to answer.",
        "A row's rate is the mean since the row before: peaks, and the slope on the thermometer's rate, come out too small.",
        "Give the profile closer rows, or `simulate` --step 30, which adds them on the straight lines between its own.";
    OneRow "one-row":
        "A profile has one row.",
        "Nothing can happen in it: the model starts at rest, and the result is one row at rest.",
        "Give rows from the start to the end of what the chamber does.";
    Fahrenheit "fahrenheit":
        "A profile's chamber_c starts at what is a room's temperature in degF and none in degC.",
        "If it is in degF, every change of temperature, and with it the bias, is 1.8 times too large.",
        "Write (F - 32) / 1.8 if so.";
    Kelvin "kelvin":
        "A profile's chamber_c never falls to what would be usual in degC: it may be in kelvin.",
        "Differences are right all the same; what depends on the temperature itself (transitions, bonds that open) is not.",
        "Subtract 273.15.";
    PoorInference "poor-inference":
        "With --spool: no smooth chamber makes the model follow the thermometer to its noise.",
        "The chamber that was inferred, and the bias under it, are in error by more than is said.",
        "Start the record at rest, give the readings' true --spool-noise, or check the design's heat paths.";
    ImpossibleResult "impossible-result":
        "The simulated thermometer leaves what temperatures can be: below absolute zero, or above 1000 degC.",
        "The model is linear and goes on all the same; its result means nothing there.",
        "Check the power of `heat.heaters` (in W, cooling is negative) and the profile.";
    // recordings as they are read
    DeclaredInterval "declared-interval":
        "The instants of a recording's rows are counted with the interval that was declared; a column of instants, if there is one, tells gaps alone.",
        "Without a column of instants lost rows cannot be seen, with one those that its clock shows; a drifting clock cannot. It is a warning where the column tells of a length that differs by more than half.",
        "Record the instants, or leave out the interval (--interval, interval_s in the map file) if the column's instants are right.";
    Footer "footer":
        "Below the last row of a recording stand lines without a number, a date or a time of day: remarks of the logger.",
        "They are not read.",
        "None is needed. A line that was a row once, and lost its numbers, is not read either: see the line that the message names.";
    LeftOutTable "left-out-table":
        "A table in a folder of recordings names instants and a coil's drives alone: it is a profile.",
        "It is not read: a profile has no rate.",
        "None is needed; to have it read all the same, give it by its name.";
    NamesAgain "names-again":
        "The line of names stands again among the rows of a recording: a logger began anew.",
        "It is not read, and neither are as many lines below it as the map file says of the first.",
        "None is needed; `check` tells a gap or a step of the clock there.";
    AbsentColumn "absent-column":
        "A recording lacks the chamber's, the spool's temperature, or the rate.",
        "What that column would tell is not used; without chamber_c there is no diagnosis.",
        "Record it, or name its column with --column KEY=NAME.";
    UnusedTemperature "unused-temperature":
        "A recording has columns that seem to be temperatures and are not read, and lacks the chamber's or the spool's.",
        "As if they were absent: without chamber_c there is no diagnosis, without spool_c heat paths cannot be told apart.",
        "Say which is which with --column chamber=NAME and --column spool=NAME, or in the map file.";
    MappedColumn "mapped-column":
        "A quantity is read from a column of another name or unit, as the flags or the map file say.",
        "None if it is the right one.",
        "Check name and unit.";
    UnitInName "unit-in-name":
        "The name of a recording's column ends in a unit in brackets, and the column is read in another.",
        "Everything that follows is off by the ratio of the units, if the name is right.",
        "Give the unit with --unit KEY=UNIT, or in the map file.";
    UnknownUnit "unknown-unit":
        "The name of a recording's column ends in brackets, and what is in them is no unit that is known.",
        "The column is read in the standard unit: everything that follows is off by the ratio of the units.",
        "Give the unit with --unit KEY=UNIT and --scale KEY=FACTOR (values are FACTOR units), or unit and scale in the map file.";
    Dates "dates":
        "Instants are dates.",
        "They count in seconds from the first row.",
        "None is needed.";
    TimesOfDay "times-of-day":
        "Instants are times of day without a date.",
        "They count from the first row, and a day is added where they pass midnight; a gap of more than half a day is not seen.",
        "Record the date too, if the logger can.";
    IntervalDiffers "interval-differs":
        "The rows are not as far apart as the meta file says.",
        "The interval of the rows is used; noise per root hour follows from it.",
        "Check the unit of the instants, or mend `sample_interval_s`.";
    MetaContradicted "meta-contradicted":
        "A number of the meta file is several times what the record itself shows, or lies further from it than its own uncertainty.",
        "What the meta file says is believed: noise, offsets and what is left are weighed by it.",
        "Correct the number in the meta file, or leave it out: what is not known is found from the record. If noise or offset are a factor such as 3.6 or 60 off, check the column's unit first.";
    // recordings as they are judged: the kinds of `check`
    Gap "gap":
        "Rows are missing: an interval is much longer than usual.",
        "The gap is bridged by lines for temperatures; what happened to the bias within it is not known.",
        "Find out why the logger paused; a gap during a ramp is worth a repeat.";
    Jitter "jitter":
        "The intervals between rows vary.",
        "Nothing: instants are used as they are.",
        "None is needed, unless the logger's clock was meant to be even.";
    Duplicate "duplicate":
        "A row repeats an earlier one, instant and values, as where a logger wrote a block twice.",
        "It is dropped.",
        "None is needed.";
    Conflict "conflict":
        "One instant stands in two rows with different values.",
        "The recording cannot be used: which row is right is not known.",
        "Keep the row that is right.";
    Backwards "backwards":
        "Time goes back from one row to the next.",
        "The recording cannot be used.",
        "Sort the rows by time, or split the file where the clock restarts.";
    ClockStep "clock-step":
        "An interval is no whole number of usual intervals: the clock was set.",
        "Instants after it are off by a fixed amount; a fast ramp then shifts against the bias.",
        "Split the file there, or mend the instants.";
    Missing "missing":
        "Fields are empty or not numbers such as NaN.",
        "They are not used.",
        "None is needed if they are few; else check the logger.";
    Outliers "outliers":
        "Lone values lie far from their neighbours (more than 6.5 standard deviations of the noise from the median of six).",
        "They are not used.",
        "Look for interference, or for a connector, if they are many.";
    Stuck "stuck":
        "The same value repeats for longer than noise and resolution explain.",
        "The run is not used where noise would show; where the resolution hides it, it is.",
        "Check the sensor and its range.";
    Saturation "saturation":
        "A channel stays at its largest or least value for longer than noise explains.",
        "The run is not used.",
        "Check the range of sensor and converter.";
    Held "held":
        "Each value of a channel stands for several rows, as if a slower logger's were repeated until the next.",
        "The row in which a value is new is used. Of a rate, which is a mean, the rows between are dropped; of a temperature they count as missing. \
         When a value was read is known to a row only: a diagnosis allows the rate's clock as much.",
        "None is needed if values stand for a whole number of rows. If not, each is off by another part of a row, and ramps tell less: give the slower \
         logger's own rows.";
    Quantised "quantised":
        "The resolution of a channel is coarser than its noise.",
        "Its noise is known as an upper bound only, and small effects below a step cannot be seen.",
        "Record more digits.";
    Unit "unit":
        "A channel's values, or its noise, are not of the size that its unit makes them, or it starts at what another unit makes a room's temperature.",
        "Everything that follows is off by the ratio of the units; a recording whose rate is impossible at rest, or far too small, cannot be used.",
        "Give the unit with --unit KEY=UNIT, or in the map file.";
    TooFast "too-fast":
        "The chamber changes by more than 30 K/min for several rows: twice the fastest rate of the standard for chambers (IEC 60068-2-14, Nb).",
        "If the instants are in another unit, every time constant and rate of change is off by the ratio of the units.",
        "Give the unit of the instants with --unit time=UNIT, or in the map file.";
    Span "span":
        "A recording of many rows lasts less than a minute, or one lasts longer than 100 days.",
        "If the instants are in another unit, every time constant and rate of change is off by the ratio of the units.",
        "Give the unit of the instants with --unit time=UNIT, or in the map file.";
    Impossible "impossible":
        "Values lie beyond what physics allows (absolute zero, what a coil survives), or repeat far outside what is plausible: a logger's code \
         for an overload or a lost sensor.",
        "They are not used.",
        "Check the sensor, its cable and its range.";
    Moving "moving":
        "The rate is beyond a hundred times the Earth's in several rows that are no outliers.",
        "The recording cannot be used: the unit was not at rest, and may have stood differently afterwards.",
        "Cut out the rows in which it was moved, and those on one side of them.";
    Constant "constant":
        "A channel has one value throughout.",
        "It tells nothing; a recording whose rate, or whose chamber, is constant cannot be used.",
        "Check the sensor's cable and the choice of the column.";
    Empty "empty":
        "A channel has no value at all.",
        "As if the column were absent; a recording without a rate cannot be used.",
        "Check the sensor's cable and the choice of the column.";
    TooShort "too-short":
        "The recording has few rows.",
        "Noise and slow effects cannot be told from one another, or nothing can be said.",
        "Give a longer recording.";
    Offset "offset":
        "The median rate is larger than a gyroscope's bias, or differs by more than that from the Earth's rate of the meta file; the Earth's rate would explain it, or even that does not, as the message says.",
        "The offset is fitted; a model's absolute bias is not tested.",
        "Subtract the Earth's rate along the axis (15.04 deg/h times the sine of the latitude for a vertical one), or accept it; \
         beyond 15.04 deg/h check unit and scale.";
    Line "line":
        "The rate has a line: a sinusoid of one period, 20 cycles or more in the record, that noise makes in fewer than one record in a million. Fitted and taken off are at most eight.",
        "It is kept out of the noise and its Allan deviation. A diagnosis takes it off the rate where no temperature has it and it is the same in every quarter of the record; else it is compared as it is. A sensitivity is fitted beside it. Rows fold a fast one: of a line of frequency f in rows at an interval t, f may be any whole number of 1/t more or less.",
        "Look for mains hum, a fan, a pump or a converter, and at the chamber's controller if the chamber's temperature has the line, too. Rows at another interval show a folded line at another period.";
    OtherFinding "other":
        "`check` found something that has no page of its own.",
        "The message says it.",
        "Look at the rows that the message names.";
    // diagnosis
    Averaged "averaged-rows":
        "A recording has very many rows: neighbours are averaged.",
        "None on what takes minutes, as a coil's transients do; faster noise is averaged away.",
        "None is needed.";
    NarrowRange "narrow-range":
        "The chamber moves by a few kelvin only.",
        "Mechanisms that act beyond a temperature, or with it, cannot show.",
        "Test over the range of use; `fogcoil recommend` proposes a programme.";
    NotOffered "mechanism-not-offered":
        "The design leaves a mechanism no place: no flange, no bond that holds, a film or a heater of its own, constants that are not those of silica in a polymer.",
        "It is not among the explanations: its effect would be unknown, or taken for that of another which resembles it.",
        "Nothing, if the drawing is right; else put the part into the coil file.";
    NoThermometer "no-thermometer":
        "A recording has no spool_c.",
        "Heat paths and the thermometer cannot be told apart.",
        "Record the spool's temperature.";
    NotAtRest "not-at-rest":
        "A recording starts while the chamber still moves, or spool and chamber differ.",
        "The model starts at rest: what that leaves in the first hours is no finding. A unit that is switched on with the record warms its spool, too: if the answer is self-heating, the model has that.",
        "Soak until chamber and spool agree before recording, or cut the beginning off.";
    SpoolFirst "spool-first":
        "The chamber's readings follow the spool's, with a time constant; the other way round no time constant explains them.",
        "If the columns are exchanged, every answer about the record is void.",
        "Check the header, the map file, or --column KEY=NAME; of a chamber's thermometer that is slower than the spool, state its lag_s in meta.ron.";
    ExchangedColumns "exchanged-columns":
        "The model follows the recording far better with two columns exchanged.",
        "The answer is void if they are.",
        "Check the header, or give --column KEY=NAME.";
    LooseThermometer "loose-thermometer":
        "Up to one instant the spool's thermometer follows the model, from then on the chamber.",
        "The answer is void if it came loose: a heat path is sought, or a fault of the rate, for what the thermometer does.",
        "Look at the thermometer's bond; empty `spool_c` from there on.";
    ChamberJump "chamber-jump":
        "The chamber's readings go on at another level from one row to the next, or behind a gap at another than the slopes on either side make of it. `check` notes it whatever the spool does; `diagnose` warns where the spool's thermometer goes on as if they had not.",
        "A step of the air is no fault. The answer is void if the sensor moved, or its channel: a drift, or a fault, is sought for heat that was not there.",
        "If the programme has no such step, look at the chamber's sensor and its channel; use the rows before it alone, or subtract the jump from the readings behind it.";
    ReversedRate "reversed-rate":
        "The model follows the recording far better with the rate negated.",
        "The answer is void if the sign is wrong.",
        "Check the sense of the gyro's axis and `winding.cw_climbs`; if the rate is logged with the other sign, read it so: `--scale rate=-1`.";
    RateUnit "rate-unit":
        "The rate is smaller or larger than the design makes it by the ratio of two units of rates, ten or more; in the other unit the recording is as the design predicts.",
        "The answer is void if the unit is wrong.",
        "Say the unit: `--unit rate=UNIT`, or `unit` of the rate in the map file; the message names it.";
    DoubtedDrawing "doubted-drawing":
        "The model follows the recordings far better with one word of the drawing changed: a bond that is not there, the side to which the winding climbs, or the spool's material.",
        "The answer seeks faults or constants where the unit may be made otherwise than it is drawn; records alone may not tell the two apart.",
        "Look at the unit, or ask its maker: if the word is so, put it into the coil file and diagnose again.";
    DoubtedUnit "doubted-unit":
        "A unit that `calibrate` was given as a good one is explained better by a mechanism than by its constants.",
        "What it has of a fault goes into the constants of the lot.",
        "Diagnose it alone; leave it out unless it is good.";
    UnitMisfit "unit-misfit":
        "A unit that `calibrate` was given as a good one: the design's constants leave more than twice the noise of its rows and the drift that is usual.",
        "Its constants are pulled to what the design cannot do, and those of the lot with them; the unit is not called good.",
        "Check that the unit was built to this design, and its columns and units (fogcoil check); diagnose it alone; leave it out unless it is good.";
    FewUnits "few-units":
        "A lot is calibrated from fewer than three units.",
        "A fault that one of them has looks like the lot's own: what is common to two cannot be told from what one has.",
        "Give three good units or more.";
    NotMeasured "not-measured":
        "A record does not tell one of the numbers that `measure` gives; the message says which, and why.",
        "The number is null, and no other depends on it.",
        "Record what the message names: a ramp, a rest before and after it, a temperature held from either side, more rows.";
    OneTemperature "one-temperature":
        "A sensitivity is told from a record with one temperature: of the chamber, or of the spool.",
        "It holds for a unit that settles within the time constant that the message names. What settles more slowly is missing from it where noise hides it, and the interval does not say so.",
        "Record both temperatures, which tell how slowly the unit settles, or ramps of three times its longest time constant.";
    OtherDesign "other-design":
        "A meta file says that the unit was built to a design of another name.",
        "The model may be that of another coil.",
        "Give the design that the unit was built to, or correct `design` in the meta file.";
    FitLeft "fit-left":
        "What was found leaves, in a record that was fitted, more than twice the noise that neighbouring rows show and the drift that is usual.",
        "The noise of the answer holds something that is not noise: the intervals are too wide or beside the truth, and a better explanation may not have been found.",
        "Look at the rows that the message names, and at the figure of the residuals. Tell `sample_interval_s` in a meta file if the log's instants are in doubt, or whether the rate is filtered.";
    HeldOutLeft "held-out-left":
        "What was found leaves more than 1.3 times the noise in a record that was held out (a warning from twice the noise on), or more than twice the noise that its neighbouring rows show.",
        "What was found may be right and not all: something else was at work in that record, or it is of another unit. With the warning, a unit of a batch has not passed.",
        "Check that the records are of one unit in one state, and fit the other record, too: `--fit` it, and hold out another.";
    TakenBack "taken-back":
        "The likeliest explanation predicts a record that was held out worse than the nominal model, or no better and far from its noise.",
        "The explanation is taken back: the verdict is none or unknown, and `taken_back` lists what it was.",
        "Check that the records are of one unit in one state; something may have changed between them.";
    InstrumentOff "instrument-off":
        "The answer rests on a thermometer, a clock or a scale factor that is more than three standard deviations off what is usual or was told of it.",
        "What was found may be right, or make up for what the instrument seems to do; that is the likelier the farther it is off.",
        "Check the instrument that the message names: its clock, calibration, place and column. Tell what is known of it in a meta file.";
    WrittenModel "written-model":
        "Simulated under the fitted records, the design that --model-out wrote leaves more than 1.3 times what the fit leaves.",
        "What was found stands; its sizes are rough: a strong mechanism acts otherwise than the fit takes it to, or the file rounds what was fitted.",
        "Give the written file to `diagnose` as the design, with the same records: what is left is fitted about it.";
    NoModel "no-model":
        "--model-out was given, but the verdict leaves nothing that a coil file could hold.",
        "The file is not written.",
        "If the unit is known not to have the mechanism that the message names, leave it out with --without ID; otherwise none is needed.";
    FollowsColumn "follows-column":
        "What an explanation leaves of the rate, or what the constants alone would leave, follows a column of the records that the model does not use: most of what lies beyond the noise.",
        "What was found may make up for what the column tells, such as a supply or a pressure; measurements of other parts that the answer advises may be in vain.",
        "Write what the column does to the rate as a mechanism of your own, whose file names it in `columns`, and diagnose again with --mechanism; or keep constant what the column tells.";
    WeighedColumn "weighed-column":
        "The records hold columns of numbers that the model does not use; that the rate follows one of them is weighed as a mechanism. A column that moves with the rate from row to row is left out: it seems to be made from the rate.",
        "Nothing, unless the answer names one: what such a column tells acts on the rate, or goes along with what does.",
        "None, unless the answer names one. A mechanism's file of your own (--mechanism) takes its column's place, with its own law; it is the way to have a column weighed that was left out, if it is a cause of the rate.";
    CopiedRecording "copied-recording":
        "Two units of a batch have a recording in common, byte for byte.",
        "One of them was not recorded, or its file is lost; its verdict is the other's.",
        "Look for the right file, and take the copy away.";
    LeftOut "left-out":
        "Mechanisms were not weighed, as --without says that the unit does not have them.",
        "If it has one of them all the same, another takes its place, or none.",
        "Leave out --without unless an inspection showed it.";
}

impl Remark {
    /// Whether it says that a record is read wrongly, or is no record of the unit: what is concluded from it is void.
    pub fn voids(self) -> bool {
        matches!(self, Self::ExchangedColumns | Self::LooseThermometer | Self::ChamberJump | Self::ReversedRate | Self::RateUnit)
    }

    /// The kind of a finding of [`recording::check`].
    pub fn of_finding(kind: &FindingKind) -> Self {
        match kind {
            FindingKind::Gap { .. } => Self::Gap,
            FindingKind::Jitter { .. } => Self::Jitter,
            FindingKind::Duplicate => Self::Duplicate,
            FindingKind::Conflict => Self::Conflict,
            FindingKind::Backwards { .. } => Self::Backwards,
            FindingKind::ClockStep { .. } => Self::ClockStep,
            FindingKind::Missing => Self::Missing,
            FindingKind::Outliers { .. } => Self::Outliers,
            FindingKind::Stuck { .. } => Self::Stuck,
            FindingKind::Saturation { .. } => Self::Saturation,
            FindingKind::Held { .. } => Self::Held,
            FindingKind::Quantised { .. } => Self::Quantised,
            FindingKind::Unit { .. } => Self::Unit,
            FindingKind::TooFast { .. } => Self::TooFast,
            FindingKind::Span { .. } => Self::Span,
            FindingKind::Impossible(_) => Self::Impossible,
            FindingKind::Moving { .. } => Self::Moving,
            FindingKind::Start { .. } => Self::Unit,
            FindingKind::Constant { .. } => Self::Constant,
            FindingKind::Empty => Self::Empty,
            FindingKind::TooShort { .. } => Self::TooShort,
            FindingKind::Offset { .. } => Self::Offset,
            _ => Self::OtherFinding,
        }
    }
}
