//! Maps kinds of constraints and laws to their constructors.

use std::collections::{BTreeSet, HashMap};
use std::sync::Arc;

use serde_json::{Map, Value};

use super::dimension::{self, Found};
use super::format::ArgumentData;
use super::law::{LawData, LawReader, shipped};
use super::value::Datum;
use crate::coordinates::{Coordinate, Ground, PlanarBody, SpatialBody, Target};
use crate::dimensions::Dimension;
use crate::law::Law;
use crate::model::constraint::Constraint;
use crate::model::dual_route::ArgumentKind;
use crate::model::mechanism::Mechanism;
use crate::outcome::similar;
use crate::outcome::words::list;

/// A constraint that can be created from data.
///
/// `#[constraint]` implements this trait.
pub trait Described: Constraint + Sized + 'static {
    /// The name of the function.
    const KIND: &'static str;
    /// The kinds of the arguments, in order.
    const ARGUMENTS: &'static [ArgumentKind];
    /// Creates the constraint from bodies and parameters, or returns `None`.
    ///
    /// The reader records each mistake and returns a substitute value. The method returns `None` if
    /// a parameter has no substitute value.
    fn read(from: &mut Reader<'_>) -> Option<Self>;
}

type Make = Arc<dyn Fn(&mut Reader<'_>) -> Option<Box<dyn Constraint>> + Send + Sync>;
type Key = (String, Vec<ArgumentKind>);
/// A constraint, and its parameters that are expressions of dimensions.
pub(super) type Made = (Box<dyn Constraint>, Vec<(String, Dimension)>);
type ReadEquation = fn(Registry, &str) -> Result<Registry, String>;
type ReadLaw = fn(&LawReader<'_>) -> Result<Law, String>;
type MakeLaw = Arc<dyn Fn(&LawReader<'_>) -> Result<Law, String> + Send + Sync>;

/// The origin of a constructor.
#[derive(Clone, PartialEq, Eq)]
enum Origin {
    Library,
    Program,
    /// A file with this text.
    Text(String),
}

/// Constructors of constraints and laws by their kinds.
///
/// The registry distinguishes constraints with the same name but different arguments, such as
/// `revolute` of planar and of spatial bodies. If two user-defined constraints have the same name
/// and arguments, the registry uses the later constraint. An equation in a file takes precedence
/// over user-defined constraints. A name of the library always means the constraint of the library.
#[derive(Clone)]
pub struct Registry {
    constraints: HashMap<Key, (Make, Origin)>,
    laws: HashMap<String, MakeLaw>,
    equations: Option<ReadEquation>,
    law_texts: Option<ReadLaw>,
    /// True if there are equations as text, but no reader for them.
    unread: bool,
}

impl Default for Registry {
    fn default() -> Self {
        Registry::new()
    }
}

impl Registry {
    /// Creates a registry with all joints, drivers and laws of the library.
    pub fn new() -> Registry {
        let empty = Registry {
            constraints: HashMap::new(),
            laws: HashMap::new(),
            equations: None,
            law_texts: None,
            unread: false,
        };
        let mut all = super::joints::registered(shipped(empty));
        all.constraints.values_mut().for_each(|(_, origin)| *origin = Origin::Library);
        all
    }

    /// Adds a user-defined constraint, written as a function with `#[constraint]`:
    /// `Registry::new().with::<parabolic_slot>()`.
    pub fn with<C: Described>(self) -> Registry {
        let make =
            |from: &mut Reader<'_>| C::read(from).map(|made| Box::new(made) as Box<dyn Constraint>);
        self.with_constraint(C::KIND, C::ARGUMENTS, make)
    }

    /// Adds a constraint that a program creates at run time, by its kind, its arguments and its
    /// constructor.
    pub fn with_constraint(
        mut self,
        kind: &str,
        arguments: &[ArgumentKind],
        make: impl Fn(&mut Reader<'_>) -> Option<Box<dyn Constraint>> + Send + Sync + 'static,
    ) -> Registry {
        self.constraints
            .insert((kind.to_string(), arguments.to_vec()), (Arc::new(make), Origin::Program));
        self
    }

    /// Adds a constraint whose equation a file contains as this text, for
    /// [`Registry::reading_equations`].
    ///
    /// Errors: the library, or another text of the file, has a constraint with this name and these
    /// arguments. Such a name would have different meanings in different files.
    pub fn with_equation(
        mut self,
        (kind, arguments): (&str, &[ArgumentKind]),
        text: &str,
        make: impl Fn(&mut Reader<'_>) -> Option<Box<dyn Constraint>> + Send + Sync + 'static,
    ) -> Result<Registry, String> {
        let key = (kind.to_string(), arguments.to_vec());
        let own = Origin::Text(text.to_string());
        match self.constraints.get(&key) {
            Some((_, Origin::Library)) => Err(names_of_the_library(kind)),
            Some((_, known @ Origin::Text(_))) if *known != own => Err(format!(
                "two equations `{kind}` have the same arguments. Give one of them another name"
            )),
            _ => {
                self.constraints.insert(key, (Arc::new(make), own));
                Ok(self)
            }
        }
    }

    /// Enables the registry to read the equations in mechanism files: the function `read` adds the
    /// constraint of a text.
    ///
    /// `kin::text::registry()` returns a registry with Kin's reader.
    pub fn reading_equations(
        mut self,
        read: fn(Registry, &str) -> Result<Registry, String>,
    ) -> Registry {
        self.equations = Some(read);
        self
    }

    /// Enables the registry to create laws from the texts in mechanism files.
    ///
    /// The function `read` receives the text, the numbers and the parts of a law.
    pub fn reading_laws(mut self, read: fn(&LawReader<'_>) -> Result<Law, String>) -> Registry {
        self.law_texts = Some(read);
        self
    }

    /// Returns a registry that also contains the constraints of these texts.
    ///
    /// If the registry has no reader, the program must define these constraints.
    ///
    /// Errors: a text contains a mistake.
    pub fn with_equations(&self, texts: &[String]) -> Result<Registry, String> {
        match self.equations {
            Some(read) => {
                texts.iter().try_fold(self.clone(), |registry, text| read(registry, text))
            }
            None => Ok(Registry { unread: !texts.is_empty(), ..self.clone() }),
        }
    }

    /// Adds a user-defined law by its kind (the name of its function with `#[law]`) and its
    /// constructor.
    pub fn with_law(
        mut self,
        kind: &str,
        make: impl Fn(&LawReader<'_>) -> Result<Law, String> + Send + Sync + 'static,
    ) -> Registry {
        self.laws.insert(kind.to_string(), Arc::new(make));
        self
    }

    /// Returns the kinds of the constraints, with the number of arguments of each, sorted.
    pub fn kinds(&self) -> Vec<(&str, usize)> {
        let mut all: Vec<(&str, usize)> = self
            .constraints
            .keys()
            .map(|(kind, arguments)| (kind.as_str(), arguments.len()))
            .collect();
        all.sort_unstable();
        all
    }

    /// Returns the kinds of the laws, sorted.
    pub fn law_kinds(&self) -> Vec<&str> {
        let mut all: Vec<&str> = self.laws.keys().map(String::as_str).collect();
        all.sort_unstable();
        all
    }

    /// Creates a law from data: by its kind if the registry knows the kind, otherwise by its text.
    ///
    /// Errors: the kind is unknown; a number or part is missing or superfluous; the text contains a
    /// mistake.
    pub fn law(&self, data: &LawData) -> Result<Law, String> {
        let law = LawReader::new(data, self);
        let whole = |made| law.all_are_asked().map(|()| made);
        match (self.laws.get(&data.kind), &data.text, self.law_texts) {
            (Some(make), ..) => make(&law).and_then(whole),
            (None, Some(_), Some(read)) => read(&law).and_then(whole),
            (None, text, read) => Err(self.unknown_law(&data.kind, text.is_some(), read.is_some())),
        }
    }

    fn unknown_law(&self, kind: &str, has_text: bool, reads_texts: bool) -> String {
        let known: Vec<String> = self.law_kinds().into_iter().map(str::to_string).collect();
        let own = match (has_text, reads_texts) {
            (_, true) => "give the function of a user-defined law as `text`",
            (true, _) => {
                "add it with `Registry::with_law`, or read its text with `kin::text::registry()`, of the feature `text`"
            }
            _ => "add a user-defined law with `Registry::with_law`",
        };
        let what = match kind {
            "" => "a law has no `kind`".to_string(),
            _ => format!("unknown law `{kind}`"),
        };
        format!("{what}{}, or {own}", similar::cure(kind, &known))
    }

    /// Creates a constraint, with its parameters that are expressions of dimensions. Errors: an
    /// unknown kind, arguments or parameters that do not fit.
    pub(super) fn constraint(
        &self,
        kind: &str,
        arguments: &[ArgumentData],
        parameters: &Map<String, Value>,
        mechanism: &Mechanism,
    ) -> Result<Made, String> {
        let kinds: Vec<ArgumentKind> = arguments.iter().map(ArgumentData::kind).collect();
        let key = (kind.to_string(), kinds);
        let (make, _) = self.constraints.get(&key).ok_or_else(|| self.unknown(kind, &key.1))?;
        let mut reader = Reader {
            arguments: arguments.iter(),
            parameters,
            mechanism,
            registry: self,
            asked: Vec::new(),
            expressions: Vec::new(),
            failure: None,
        };
        let made = make(&mut reader);
        let unknown = || parameters.keys().find(|name| !reader.asked.contains(name));
        match (made, &reader.failure, unknown()) {
            (_, Some(reason), _) => Err(reason.clone()),
            (_, None, Some(name)) => {
                let known: Vec<String> = reader.asked.iter().map(|one| one.to_string()).collect();
                let cure = match known[..] {
                    [] => format!(". `{kind}` takes no parameters: remove `{name}`"),
                    _ => similar::cure(name, &known),
                };
                Err(format!("`{kind}` has no parameter `{name}`{cure}"))
            }
            (made, None, None) => {
                let made = made.ok_or_else(|| format!("`{kind}` cannot be made"))?;
                let bound = dimension::bound(made.as_ref(), reader.expressions)?;
                Ok((made, bound))
            }
        }
    }

    /// Returns true if the registry knows this kind with these arguments.
    pub(super) fn knows(&self, kind: &str, arguments: &[ArgumentData]) -> bool {
        let kinds = arguments.iter().map(ArgumentData::kind).collect();
        self.constraints.contains_key(&(kind.to_string(), kinds))
    }

    /// Returns an error for a user-defined constraint with a name and arguments of the library. In
    /// a file that name means the library.
    pub(super) fn is_free(kind: &str, arguments: &[ArgumentData]) -> Result<(), String> {
        if Registry::new().knows(kind, arguments) {
            Err(names_of_the_library(kind))
        } else {
            Ok(())
        }
    }

    fn unknown(&self, kind: &str, arguments: &[ArgumentKind]) -> String {
        let takes: BTreeSet<String> = self
            .constraints
            .keys()
            .filter(|(known, _)| known == kind)
            .map(|(_, takes)| signature(takes))
            .collect();
        if !takes.is_empty() {
            return format!(
                "no `{kind}` is known with these {} arguments, {}. `{kind}` takes {}",
                arguments.len(),
                signature(arguments),
                Vec::from_iter(takes).join(" or ")
            );
        }
        if self.unread {
            return format!(
                "unknown constraint `{kind}`: the file carries equations as text; read it with `kin::text::registry()`, of the feature `text`"
            );
        }
        let own = match self.equations.is_some() || self.law_texts.is_some() {
            true => "give the text of a user-defined constraint in `equations` of the file".into(),
            false => format!("add a user-defined one with `Registry::with::<{kind}>()`"),
        };
        format!("unknown constraint `{kind}`{}, or {own}", self.similar_kinds(kind, arguments))
    }

    /// Returns the cure for an unknown kind: the kinds that take these arguments, or all kinds if
    /// one of the others is meant.
    fn similar_kinds(&self, kind: &str, arguments: &[ArgumentKind]) -> String {
        let of = |fits: &dyn Fn(&[ArgumentKind]) -> bool| -> Vec<String> {
            let kinds = self.constraints.keys().filter(|(_, takes)| fits(takes));
            let kinds: BTreeSet<String> = kinds.map(|(kind, _)| kind.clone()).collect();
            kinds.into_iter().collect()
        };
        let fitting = similar::cure(kind, &of(&|takes| takes == arguments));
        let any = similar::cure(kind, &of(&|_| true));
        if fitting.is_empty() || any.contains("Did you mean") { any } else { fitting }
    }
}

/// "(planar body, coordinate)".
fn signature(kinds: &[ArgumentKind]) -> String {
    let word = |kind: &ArgumentKind| match kind {
        ArgumentKind::Planar => "planar body",
        ArgumentKind::Spatial => "spatial body",
        ArgumentKind::Coord => "coordinate",
    };
    format!("({})", kinds.iter().map(word).collect::<Vec<&str>>().join(", "))
}

fn names_of_the_library(kind: &str) -> String {
    format!("the library has a `{kind}` with the same arguments. Give the equation another name")
}

/// The data of one constraint, from which a constructor reads bodies and parameters.
pub struct Reader<'a> {
    arguments: std::slice::Iter<'a, ArgumentData>,
    parameters: &'a Map<String, Value>,
    mechanism: &'a Mechanism,
    registry: &'a Registry,
    asked: Vec<&'a String>,
    /// The expressions of dimensions in place of numbers.
    expressions: Vec<Found>,
    /// The first mistake in the data.
    failure: Option<String>,
}

impl<'a> Reader<'a> {
    /// Returns the next argument, a planar body, or the ground if the data contain no such
    /// argument.
    pub fn planar(&mut self) -> PlanarBody {
        let found = match self.arguments.next() {
            Some(ArgumentData::Planar(None)) => Ok(Ground.into()),
            Some(ArgumentData::Planar(Some(name))) => {
                self.mechanism.planar_named(name).ok_or_else(|| self.no_body("planar", name))
            }
            _ => Err("a planar body is missing".to_string()),
        };
        self.noted(found).unwrap_or(Ground.into())
    }

    /// Returns the next argument, a spatial body, or the ground if the data contain no such
    /// argument.
    pub fn spatial(&mut self) -> SpatialBody {
        let found = match self.arguments.next() {
            Some(ArgumentData::Spatial(None)) => Ok(Ground.into()),
            Some(ArgumentData::Spatial(Some(name))) => {
                self.mechanism.spatial_named(name).ok_or_else(|| self.no_body("spatial", name))
            }
            _ => Err("a spatial body is missing".to_string()),
        };
        self.noted(found).unwrap_or(Ground.into())
    }

    /// Returns the next argument, a scalar coordinate, or a coordinate of the ground if the data
    /// contain no such argument.
    pub fn coord(&mut self) -> Coordinate {
        let found = match self.arguments.next() {
            Some(ArgumentData::Coord(name)) => {
                self.mechanism.coordinate_named(name).ok_or_else(|| self.no_coordinate(name))
            }
            Some(ArgumentData::GroundCoord(axis)) => Ok(Coordinate::Planar(Ground.into(), *axis)),
            Some(ArgumentData::SpatialGroundCoord(axis)) => {
                Ok(Coordinate::Spatial(Ground.into(), *axis))
            }
            _ => Err("a coordinate is missing".to_string()),
        };
        self.noted(found).unwrap_or(Coordinate::Planar(Ground.into(), 0))
    }

    /// The mistake of a name that no body of this kind has, "planar" or "spatial".
    fn no_body(&self, kind: &str, name: &str) -> String {
        if name == "ground" {
            return format!("no {kind} body `ground`. The ground is null: {{\"{kind}\": null}}");
        }
        let bodies = self.mechanism.layout.bodies();
        let word = |target: &Target| match target {
            Target::Planar(_) => "planar",
            Target::Spatial(_) => "spatial",
            Target::Coord(..) => "coord",
        };
        if let Some((_, other)) = bodies.iter().find(|(known, _)| *known == name) {
            let is = match word(other) {
                "coord" => "a coordinate".to_string(),
                other => format!("a {other} body"),
            };
            let other = word(other);
            return format!(
                "no {kind} body `{name}`: `{name}` is {is}, as an argument {{\"{other}\": \"{name}\"}}"
            );
        }
        let known = bodies.iter().filter(|(_, target)| word(target) == kind);
        let known: Vec<String> = known.map(|(name, _)| name.to_string()).collect();
        let cure = match known[..] {
            [] => format!(". The file has no {kind} body: declare it in `bodies`"),
            _ => similar::cure(name, &known),
        };
        format!("no {kind} body `{name}`{cure}")
    }

    fn no_coordinate(&self, name: &str) -> String {
        let known = &self.mechanism.layout.names;
        let cure = match known[..] {
            [] => ". The file has no body: declare it in `bodies`".to_string(),
            _ => similar::cure(name, known),
        };
        format!("no coordinate `{name}`{cure}")
    }

    /// Returns the parameter with this name, or NaN if the data contain no such parameter.
    pub fn get<T: Datum>(&mut self, name: &str) -> T {
        let registry = self.registry;
        self.numbers(name, &mut |value| T::from_value(value, registry)).unwrap_or_else(T::absent)
    }

    /// Returns a parameter that consists of numbers, some of which may be expressions of dimensions
    /// in the file.
    ///
    /// The function `read` receives the values of the numbers, as in [`Reader::value`].
    pub fn numbers<T>(
        &mut self,
        name: &str,
        read: &mut dyn FnMut(&Value) -> Result<T, String>,
    ) -> Option<T> {
        let mechanism = self.mechanism;
        let mut found = Vec::new();
        let value = self.value(name, &mut |value| {
            found.clear();
            read(&dimension::without_expressions(mechanism, name, value, &mut found)?)
        });
        self.expressions.append(&mut found);
        value
    }

    /// Returns the value that `read` creates from the JSON of the parameter with this name.
    pub fn value<T>(
        &mut self,
        name: &str,
        read: &mut dyn FnMut(&Value) -> Result<T, String>,
    ) -> Option<T> {
        let Some((known, value)) = self.parameters.get_key_value(name) else {
            let given = self.parameters.keys().filter(|given| !self.asked.contains(given));
            let given: Vec<String> = given.cloned().collect();
            let cure = match given[..] {
                [] => ". Add it".to_string(),
                _ => format!(". Is it meant by {}?", list(&similar::nearest_first(name, given))),
            };
            return self.noted(Err(format!("its parameter `{name}` is missing{cure}")));
        };
        self.asked.push(known);
        self.noted(read(value).map_err(|reason| format!("its parameter `{name}`: {reason}")))
    }

    /// Records the first mistake.
    pub(super) fn noted<T>(&mut self, found: Result<T, String>) -> Option<T> {
        match found {
            Ok(value) => Some(value),
            Err(reason) => {
                self.failure.get_or_insert(reason);
                None
            }
        }
    }
}
