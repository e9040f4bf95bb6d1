//! Everything that ends a command early, and the exit code that tells which of it was.

use kin::Error;
use serde_json::{Value, json};

/// The reason why a command has not done what it was asked.
pub enum Fault {
    /// The mechanism cannot do what is asked of it.
    Mechanism(Box<Error>),
    /// The mechanism's fault too, which has been told already.
    Reported,
    /// The command line does not make sense.
    Usage(String),
    /// The run has ended before its last time; what came before has been written.
    Early(Box<Error>),
    /// The motion is not proved, which has been told already.
    NotProved(String),
    /// A file cannot be read or written, or is none of a mechanism.
    File(String),
    /// Nobody reads the standard output any more.
    Pipe,
}

impl Fault {
    /// The exit code.
    pub fn code(&self) -> u8 {
        match self {
            Fault::Pipe => 0,
            Fault::Mechanism(_) | Fault::Reported => 1,
            Fault::Usage(_) => 2,
            Fault::Early(_) => 3,
            Fault::NotProved(_) => 4,
            Fault::File(_) => 5,
        }
    }

    fn name(&self) -> &'static str {
        match self {
            Fault::Pipe => "pipe",
            Fault::Mechanism(_) | Fault::Reported => "mechanism",
            Fault::Usage(_) => "usage",
            Fault::Early(_) => "ended early",
            Fault::NotProved(_) => "not proved",
            Fault::File(_) => "file",
        }
    }

    /// The sentence; `None` where all has been said.
    pub fn message(&self) -> Option<String> {
        match self {
            Fault::Pipe | Fault::Reported => None,
            Fault::Mechanism(error) | Fault::Early(error) => Some(error.to_string()),
            Fault::Usage(text) | Fault::NotProved(text) | Fault::File(text) => Some(text.clone()),
        }
    }

    /// Why a run has ended early, for a page that shows the motion up to there; empty of other
    /// faults.
    pub fn why_early(&self) -> String {
        match self {
            Fault::Early(error) => error.reason(),
            _ => String::new(),
        }
    }

    /// The fault as data: code, name, sentence, and the diagnosis where there is one.
    pub fn to_json(&self) -> Value {
        let diagnosis = match self {
            Fault::Mechanism(error) | Fault::Early(error) => error.diagnosis(),
            _ => None,
        };
        let mut told =
            json!({ "code": self.code(), "kind": self.name(), "message": self.message() });
        if let Some(diagnosis) =
            diagnosis.and_then(|diagnosis| serde_json::to_value(diagnosis).ok())
        {
            told["diagnosis"] = diagnosis;
        }
        json!({ "error": told })
    }

    /// An error about something that the command line names.
    pub fn asked(error: Error) -> Fault {
        match error {
            // The sentence lists eight of them.
            Error::UnknownName { ref known, .. } if known.len() > 8 => {
                Fault::Usage(format!("{error}. `kin check FILE --names` lists all"))
            }
            Error::UnknownName { .. }
            | Error::ParameterNotFinite { .. }
            | Error::InvalidParameters { .. }
            | Error::InvalidConstraint { .. }
            | Error::DuplicateName { .. }
            | Error::EmptyName { .. }
            | Error::NoDerivative(_) => Fault::Usage(error.to_string()),
            other => other.into(),
        }
    }
}

impl From<Error> for Fault {
    fn from(error: Error) -> Fault {
        match error {
            Error::InvalidTimes { .. }
            | Error::InvalidOptions { .. }
            | Error::CannotEmit { .. }
            | Error::NeedsMemory { .. } => Fault::Usage(error.to_string()),
            Error::Data { .. } | Error::Table { .. } | Error::File { .. } => {
                Fault::File(error.to_string())
            }
            Error::CannotBeProved { .. } => Fault::NotProved(error.to_string()),
            other => Fault::Mechanism(Box::new(other)),
        }
    }
}

#[cfg(test)]
mod tests {
    use std::io::ErrorKind;

    use super::*;

    /// Every sentence of an error that the command can meet is in its own words: the texts of Kin's
    /// sources, by the names of Rust in them. `Surface` chooses words for each reader, and is left
    /// out. Listed is what rustc alone tells, or Kin tells to programs in Rust alone.
    #[test]
    fn no_error_of_the_command_speaks_of_rust() {
        const TO_PROGRAMS: [&str; 8] = [
            "Registry::",
            "kin::text",
            "Lanes::Best",
            "SpatialPose::",
            "Axis::new",
            "spatial::revolute",
            "kin::loads",
            "spatial::",
        ];
        const OTHERS: [&str; 1] = ["Law::constant"];
        let core = std::path::Path::new(env!("CARGO_MANIFEST_DIR")).join("../kin-core/src");
        let mut open = vec![core];
        let mut searched = 0;
        while let Some(path) = open.pop() {
            if path.is_dir() {
                open.extend(
                    std::fs::read_dir(&path)
                        .expect("a folder")
                        .map(|entry| entry.expect("an entry").path()),
                );
                continue;
            }
            if path.components().any(|part| part.as_os_str() == "tests")
                || path.ends_with("outcome/error/surface.rs")
                || path.extension().is_none_or(|is| is != "rs")
            {
                continue;
            }
            let source = std::fs::read_to_string(&path).expect("a source");
            let source =
                source.split("#[cfg(test)]").next().unwrap_or_default().replace("\\\n", "");
            for line in source.lines().map(str::trim_start).filter(|line| !line.starts_with("//")) {
                for text in line.split('"').skip(1).step_by(2).filter(|text| text.contains('`')) {
                    let words: Vec<&str> = text.split_whitespace().collect();
                    searched += 1;
                    let told = words.join(" ");
                    for name in
                        told.split('`').skip(1).step_by(2).filter(|name| name.contains("::"))
                    {
                        let known =
                            TO_PROGRAMS.iter().chain(&OTHERS).any(|known| name.contains(known));
                        assert!(known, "{}: `{name}` in \"{told}\"", path.display());
                    }
                }
            }
        }
        assert!(searched > 250, "{searched} sentences");
    }

    /// Classes that only programs meet have codes too; `tests/command/classes.rs` has all others.
    #[test]
    fn classes_of_programs_have_codes() {
        let [place, name] = ["place", "name"].map(str::to_string);
        let foreign = Error::ForeignBody {
            mechanism: name.clone(),
            place: place.clone(),
            argument: name.clone(),
        };
        let table = Error::Table { path: name.clone().into(), reason: place.clone() };
        let file = Error::File { path: name.clone().into(), source: ErrorKind::NotFound.into() };
        let length = Error::WrongLength { what: name.clone(), expected: 2, found: 3 };
        let stopped = Error::Stopped { done: 1, all: 2, motion: None };
        let value = Error::ParameterNotFinite {
            constraint: place,
            parameter: name.clone(),
            value: f64::NAN,
        };
        let all = [(foreign, 1), (table, 5), (file, 5), (length, 1), (stopped, 1), (value, 1)];
        for (error, code) in all {
            assert_eq!(Fault::from(error).code(), code);
        }
        let value =
            Error::InitialNotFinite { name: name.clone(), coordinate: name, value: f64::NAN };
        assert_eq!(Fault::from(value).code(), 1);
    }
}
