//! Creates the JSON Schema of mechanism files from the registry that reads them.

use serde_json::{Map, Value, json};

use super::{FORMAT, Registry};

/// Returns the JSON Schema (draft 2020-12) of mechanism files, which
/// [`crate::Mechanism::write_json`] or a user writes.
///
/// The schema suggests the known kinds of constraints and laws. The schema also permits other
/// kinds, because files and programs can define kinds.
///
/// ```
/// let schema = kin::data::schema(&kin::data::Registry::new());
/// assert_eq!(schema["properties"]["bodies"]["type"], "array");
/// ```
pub fn schema(registry: &Registry) -> Value {
    let list =
        |of: &str, told: &str| json!({ "description": told, "type": "array", "items": named(of) });
    json!({
        "$schema": "https://json-schema.org/draft/2020-12/schema",
        "title": "A mechanism of Kin",
        "type": "object",
        "required": ["name", "bodies", "constraints"],
        "additionalProperties": false,
        "properties": {
            "format": {
                "description": "Version of the format.",
                "type": "integer", "minimum": 1, "maximum": FORMAT, "default": 1,
            },
            "name": text("Name of the mechanism."),
            "units": object("Names of its units.", &["length", "time"], &[
                ("length", text("The word for the unit of length, such as mm.")),
                ("time", text("The word for the unit of time, such as s.")),
                ("mass", text("The word for the unit of mass, such as kg.")),
            ]),
            "equations": {
                "description": "User-defined equations of constraints, as text in the language of `#[constraint]`.",
                "type": "array", "items": { "type": "string" },
            },
            "dimensions": list("dimension", "Named dimensions, which other numbers may be expressions of."),
            "bodies": list("body", "Bodies and bare coordinates in their order."),
            "constraints": list("constraint", "Constraints in their order."),
            "limits": list("limit", "Ranges that measures should keep to."),
            "preferred": list("preferred", "Measures by whose values an assembly is preferred."),
            "masses": list("mass", "Masses of bodies."),
            "point_masses": list("point_mass", "Points with mass, of mechanisms in bare coordinates."),
            "gravity": vector("The acceleration of gravity; z is 0 in a plane."),
            "loads": list("load", "What acts on the mechanism."),
            "frictions": list("friction", "Dry friction in joints."),
        },
        "$defs": {
            "body": body(),
            "dimension": dimension(),
            "mass": mass(),
            "point_mass": point_mass(),
            "load": load(),
            "friction": friction(),
            "scalar": scalar(),
            "formula": formula(),
            "number": number(),
            "constraint": constraint(registry),
            "argument": argument(),
            "law": law(registry),
            "limit": object("The range of a measure; null for no end.", &["measure"], &[
                ("measure", text("The measure or coordinate, such as slot.slide.")),
                ("from", number_or_null("Its lower end.")),
                ("to", number_or_null("Its upper end.")),
            ]),
            "preferred": object("The value of a measure in the assembly that is meant.", &["measure", "value"], &[
                ("measure", text("The measure, such as elbow.angle.")),
                ("value", named("number")),
            ]),
        },
    })
}

fn body() -> Value {
    let guess =
        "R_x, R_y, θ of a planar body; R, e0..e3 of a spatial one; the value of a bare coordinate.";
    object(
        "A body or bare coordinate with its guess.",
        &["name", "kind", "guess"],
        &[
            ("name", text("Its name.")),
            ("kind", json!({ "enum": ["planar", "spatial", "angle", "length"] })),
            ("guess", json!({ "description": guess, "type": "array", "items": named("number") })),
            (
                "preferred",
                json!({
                    "description": "Preferred values of its coordinates, null for none.",
                    "type": "array", "items": { "type": ["number", "string", "null"] },
                }),
            ),
            (
                "length",
                json!({
                    "description": "Length between the pins of a link.",
                    "type": ["number", "string", "null"], "exclusiveMinimum": 0,
                }),
            ),
            (
                "between",
                json!({
                    "description": "The points that a spatial body is drawn between, for a guess that depends on dimensions.",
                    "type": ["array", "null"], "minItems": 2, "maxItems": 2,
                    "items": { "type": "array", "items": named("number"), "minItems": 3, "maxItems": 3 },
                }),
            ),
            (
                "facing",
                json!({
                    "description": "Where a spatial body is, and the components of one or two directions that it faces, for a guess that depends on dimensions.",
                    "type": ["array", "null"], "items": named("number"), "minItems": 6, "maxItems": 9,
                }),
            ),
        ],
    )
}

/// A number, or an expression of dimensions.
fn number() -> Value {
    let told = "A number, or an expression of dimensions such as crank / 2.";
    json!({ "description": told, "type": ["number", "string"] })
}

fn dimension() -> Value {
    let ends =
        json!({ "type": "array", "items": { "type": "number" }, "minItems": 2, "maxItems": 2 });
    object(
        "A named number on which others depend.",
        &["name", "value"],
        &[
            ("name", text("Its name.")),
            ("value", named("number")),
            ("unit", text("The word for its unit.")),
            ("within", json!({ "anyOf": [ends, { "type": "null" }] })),
            ("tolerance", number_or_null("How far it may be off, to either side.")),
            (
                "distribution",
                json!({ "enum": ["normal", "truncated_normal", "uniform", "disc", null] }),
            ),
            (
                "clearance",
                json!({ "type": ["string", "null"], "description": "The clearance to which this dimension belongs." }),
            ),
        ],
    )
}

fn mass() -> Value {
    let rows = json!({ "type": "array", "items": vector("A row."), "minItems": 3, "maxItems": 3 });
    object(
        "The mass of a body, its centre and its inertia about the centre, in the body's axes.",
        &["body", "mass", "centre", "inertia"],
        &[
            ("body", text("Name of the body.")),
            ("mass", json!({ "type": ["number", "string"], "minimum": 0 })),
            ("centre", vector("The centre of mass; z is 0 in a plane.")),
            ("inertia", rows),
        ],
    )
}

fn point_mass() -> Value {
    object(
        "A mass at a point: a function of two or three rows, its global coordinates.",
        &["name", "point", "mass"],
        &[
            ("name", text("Its name.")),
            ("point", named("scalar")),
            ("mass", json!({ "type": ["number", "string"], "exclusiveMinimum": 0 })),
        ],
    )
}

fn load() -> Value {
    let measure = text("Name of a measure of a joint or of a coordinate, such as guide.slide.");
    let measure = object("A measure to act along.", &["measure"], &[("measure", measure)]);
    let acting = json!({ "oneOf": [
        object("", &["energy"], &[("energy", named("scalar"))]),
        object("", &["along"], &[("along", object(
            "A force along a length or an angle.",
            &["x", "force"],
            &[("x", json!({ "oneOf": [named("scalar"), measure] })), ("force", named("formula"))],
        ))]),
        object("", &["on_body"], &[("on_body", on_body())]),
    ] });
    object(
        "What acts under one name.",
        &["name", "parts"],
        &[
            ("name", text("Its name.")),
            ("parts", json!({ "type": "array", "items": acting, "minItems": 1 })),
        ],
    )
}

fn friction() -> Value {
    let kinds = ["number", "string"];
    let above_zero =
        |told: &str| json!({ "description": told, "type": kinds, "exclusiveMinimum": 0 });
    let at_least_zero = |told: &str| json!({ "description": told, "type": kinds, "minimum": 0 });
    let pin = [
        ("radius", above_zero("The radius of the pin.")),
        ("length", at_least_zero("The length of its bearing; 0 where it is short.")),
    ];
    let slide = [
        ("length", above_zero("The length of the guide.")),
        ("width", at_least_zero("The width of the guide.")),
    ];
    let mut all = object(
        "Dry friction in a joint: of a pin or of a slide.",
        &["joint", "coefficient", "rate"],
        &[
            ("joint", text("Name of the joint.")),
            ("coefficient", at_least_zero("The coefficient.")),
            ("rate", above_zero("The rate of the slip at which it sets in.")),
            ("pin", object("A pin.", &["radius"], &pin)),
            ("slide", object("A slide.", &["length", "width"], &slide)),
        ],
    );
    all["oneOf"] = json!([{ "required": ["pin"] }, { "required": ["slide"] }]);
    all
}

fn on_body() -> Value {
    let laws = |told: &str| {
        json!({
            "description": told, "type": "array", "items": named("law"), "minItems": 3, "maxItems": 3,
        })
    };
    object(
        "A force at a point of a body, and a torque.",
        &["body"],
        &[
            ("body", text("Name of the body.")),
            ("point", vector("The point in the body's frame; z is 0 in a plane.")),
            ("force", laws("Components of the force.")),
            ("torque", laws("Components of the torque; in a plane the last one counts.")),
            (
                "in_body",
                json!({ "description": "True if components are in the body's axes.", "type": "boolean" }),
            ),
        ],
    )
}

/// An energy, a length or an angle.
fn scalar() -> Value {
    object(
        "An energy, a length or an angle to act along, or a point with mass.",
        &["kind", "arguments"],
        &[
            ("kind", text("Name of its function, in the library or under `equations`.")),
            ("arguments", json!({ "type": "array", "items": named("argument") })),
            ("parameters", json!({ "description": "Its parameters by name.", "type": "object" })),
        ],
    )
}

/// A function of a length or an angle, its derivative and time.
fn formula() -> Value {
    object(
        "A force by the length or angle that it acts along, by its rate and by time.",
        &["kind"],
        &[
            ("kind", text("Name of its function, in the library or under `equations`.")),
            ("parameters", json!({ "description": "Its parameters by name.", "type": "object" })),
        ],
    )
}

fn vector(told: &str) -> Value {
    json!({
        "description": told,
        "type": "array", "items": named("number"), "minItems": 3, "maxItems": 3,
    })
}

fn constraint(registry: &Registry) -> Value {
    let mut kinds: Vec<&str> = registry.kinds().into_iter().map(|(kind, _)| kind).collect();
    kinds.dedup();
    object(
        "A constraint by its kind, arguments and parameters.",
        &["name", "kind", "arguments"],
        &[
            ("name", text("Its name.")),
            (
                "kind",
                json!({
                    "description": "Name of its function, in the library or under `equations`.",
                    "anyOf": [{ "enum": kinds }, { "type": "string" }],
                }),
            ),
            (
                "arguments",
                json!({
                    "description": "The bodies and coordinates that it acts on, in the order of its signature.",
                    "type": "array", "items": named("argument"),
                }),
            ),
            (
                "parameters",
                json!({
                    "description": "Its parameters by name: a number, lists of numbers, a law.", "type": "object",
                }),
            ),
            (
                "lacking",
                json!({
                    "description": "What its text refers to and the file does not contain.",
                    "type": "array", "items": { "type": "string" },
                }),
            ),
        ],
    )
}

/// One of several objects with one key.
fn argument() -> Value {
    let one = |key: &str, value: Value| object("", &[key], &[(key, value)]);
    let body = |told: &str| json!({ "description": told, "type": ["string", "null"] });
    let axis = |told: &str| json!({ "description": told, "type": "integer", "minimum": 0 });
    json!({ "oneOf": [
        one("planar", body("A planar body; null is the ground.")),
        one("spatial", body("A spatial body; null is the ground.")),
        one("coord", text("A coordinate by its name, such as crank.theta.")),
        one("ground_coord", axis("A coordinate of the ground as a planar body, by its number.")),
        one("spatial_ground_coord", axis("A coordinate of the ground as a spatial body, by its number.")),
    ] })
}

fn law(registry: &Registry) -> Value {
    object(
        "A law: its kind, or its function as text; its own numbers, the laws that it is made of.",
        &[],
        &[
            ("kind", json!({ "anyOf": [{ "enum": registry.law_kinds() }, { "type": "string" }] })),
            (
                "text",
                text(
                    "Its function, fn lift(x: f64, h: f64) -> f64 { … }, for readers that do not know its kind.",
                ),
            ),
            ("numbers", json!({ "type": "object", "additionalProperties": named("number") })),
            ("parts", json!({ "type": "object", "additionalProperties": named("law") })),
        ],
    )
}

fn named(definition: &str) -> Value {
    json!({ "$ref": format!("#/$defs/{definition}") })
}

fn text(told: &str) -> Value {
    json!({ "description": told, "type": "string" })
}

fn number_or_null(told: &str) -> Value {
    json!({ "description": told, "type": ["number", "null"] })
}

/// An object with exactly these members.
fn object(told: &str, required: &[&str], members: &[(&str, Value)]) -> Value {
    let members: Map<String, Value> =
        members.iter().map(|(name, value)| ((*name).to_string(), value.clone())).collect();
    let mut all = json!({ "type": "object", "required": required, "additionalProperties": false });
    all["properties"] = Value::Object(members);
    if !told.is_empty() {
        all["description"] = json!(told);
    }
    all
}
