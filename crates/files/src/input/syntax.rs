//! The RON reader's errors in the words of someone who writes case files.

use ron::Error;

use super::name::meant;
use super::rows::quoted;

pub(super) const MISSING: &str = "the field is missing";

/// Choices that are written with several numbers: their names in the program, and their form in a file.
const FORMS: [(&str, &str); 4] = [
    ("PriorFile::Normal", "write Normal(mean, standard deviation), e.g. Normal(0.0, 0.01)"),
    ("PriorFile::LogNormal", "write LogNormal(median, standard deviation of the logarithm), e.g. LogNormal(1800.0, 1.0)"),
    ("PriorFile::Uniform", "write Uniform(low, high), e.g. Uniform(0.0, 50.0)"),
    ("a tuple of size 3", "write (\"first key\", \"second key\", 0.5)"),
];

/// A choice that was written with too few or too many values: problem and remedy.
fn length(expected: &str, found: usize) -> (String, String) {
    let form = FORMS.iter().find(|(name, _)| expected.contains(name)).map_or("compare with the reference file", |(_, form)| form);
    let values = if found == 1 { "1 value is given".to_owned() } else { format!("{found} values are given") };
    (format!("{values}, which is not how many are needed"), form.to_owned())
}

/// Problem and remedy; `rest` is the text from where the reader stopped.
pub(crate) fn explain(error: &Error, rest: &str) -> (String, String) {
    let (problem, remedy) = match error {
        Error::NoSuchStructField { expected, found, .. } => {
            let known = expected.join(", ");
            let meant = meant(found, expected.iter().copied());
            return (format!("unknown field {}", quoted(found)), format!("the fields here are {known}{meant}"));
        }
        Error::NoSuchEnumVariant { expected, found, .. } => {
            let meant = meant(found, expected.iter().copied());
            return (format!("{} is not a choice here", quoted(found)), format!("choose {}{meant}", expected.join(" or ")));
        }
        Error::ExpectedDifferentLength { expected, found } => return length(expected, *found),
        // a number that its kind does not accept: problem and remedy
        Error::InvalidValueForType { expected, found } => return (found.clone(), expected.clone()),
        Error::MissingStructField { .. } => (MISSING, "add it to the group that ends here"),
        Error::DuplicateStructField { .. } => ("the field is given twice", "remove one of the two"),
        Error::ExpectedComma if rest.starts_with('.') => ("the number is not whole", "write a whole number, e.g. 36"),
        Error::ExpectedComma | Error::ExpectedArrayEnd => ("a comma or a closing bracket is missing", "add it before this point"),
        Error::ExpectedFloat => ("a number is needed", "write it like 1.5 or 1.5e-6, without quotes or unit"),
        Error::ExpectedInteger | Error::IntegerOutOfBounds | Error::InvalidIntegerDigit { .. } => {
            ("a whole number without a sign is needed", "write it like 36")
        }
        Error::ExpectedBoolean => ("`true` or `false` is needed", "write one of them"),
        Error::ExpectedString => ("a text is needed", "write it in double quotes"),
        Error::ExpectedArray => ("a list is needed", "write it in brackets, [...]"),
        Error::ExpectedMapColon => ("a colon is missing", "write `name: value`"),
        Error::ExpectedStructLike | Error::ExpectedNamedStructLike(_) | Error::ExpectedDifferentStructName { .. } => {
            ("a group of fields is needed", "write it in parentheses, (name: value, ...)")
        }
        Error::Eof
        | Error::ExpectedStructLikeEnd
        | Error::ExpectedOptionEnd
        | Error::ExpectedStringEnd
        | Error::UnclosedBlockComment => {
            ("something is left open, or the file is cut short", "close every parenthesis, bracket, text and comment")
        }
        Error::ExceededRecursionLimit => ("the brackets are nested too deeply", "compare with the reference file"),
        Error::TrailingCharacters => ("the file goes on after its closing parenthesis", "remove what follows"),
        Error::ExpectedIdentifier | Error::SuggestRawIdentifier(_) | Error::InvalidIdentifier(_) => {
            ("a name is needed", "write `name: value`, and decimals with a point")
        }
        other => return (other.to_string(), "compare with the reference file".into()),
    };
    (problem.into(), remedy.into())
}

/// Remedies of faults of syntax: for RON, for JSON.
const REMEDIES: [(&str, &str); 7] = [
    ("write `name: value`, and decimals with a point", "write it in double quotes"),
    ("write it in parentheses, (name: value, ...)", "write it in braces, {\"name\": value, ...}"),
    ("write Normal(mean, standard deviation), e.g. Normal(0.0, 0.01)", "write {\"Normal\": [mean, standard deviation]}"),
    (
        "write LogNormal(median, standard deviation of the logarithm), e.g. LogNormal(1800.0, 1.0)",
        "write {\"LogNormal\": [median, standard deviation of the logarithm]}",
    ),
    ("write Uniform(low, high), e.g. Uniform(0.0, 50.0)", "write {\"Uniform\": [low, high]}"),
    ("write (\"first key\", \"second key\", 0.5)", "write [\"first key\", \"second key\", 0.5]"),
    ("add it to the group that ends here", "add it to the braces that end here"),
];

/// A remedy of [`explain`] for who writes JSON.
pub(super) fn in_json(of_ron: String) -> String {
    REMEDIES.iter().find(|(ron, _)| *ron == of_ron).map_or(of_ron, |(_, json)| (*json).to_owned())
}
