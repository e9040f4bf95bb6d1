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
            "dimensions": list("dimension", "Named dimensions. Expressions of the dimensions can replace other numbers of the file."),
            "bodies": list("body", "Bodies, and scalar coordinates that belong to no body. Their order is the order of the coordinates in q."),
            "constraints": list("constraint", "Constraints. Their order is the order of the equations in C."),
            "limits": list("limit", "Limits of measures. A run reports an event where a measure passes a limit."),
            "preferred": list("preferred", "Measures with preferred values. Kin chooses the assembly whose measures are nearest to these values."),
            "masses": list("mass", "Masses of bodies."),
            "point_masses": list("point_mass", "Points with mass, for mechanisms that have scalar coordinates and no bodies."),
            "gravity": vector("Components of the acceleration of gravity along the global axes; in a plane the third component is 0."),
            "loads": list("load", "Forces, torques and energies that act on the mechanism."),
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
            "limit": object("The range of a measure. An end that is null means no limit.", &["measure"], &[
                ("measure", text("The measure or coordinate, such as slot.slide.")),
                ("from", number_or_null("The lower end of the range.")),
                ("to", number_or_null("The upper end of the range.")),
            ]),
            "preferred": object("The value of a measure in the preferred assembly.", &["measure", "value"], &[
                ("measure", text("The measure, such as elbow.angle.")),
                ("value", named("number")),
            ]),
        },
    })
}

fn body() -> Value {
    let guess = "The initial guess. A planar body has R_x, R_y and θ. A spatial body has R and the Euler parameters e0 to e3. A scalar coordinate has its value.";
    object(
        "A body, or a scalar coordinate that belongs to no body, with its initial guess.",
        &["name", "kind", "guess"],
        &[
            ("name", text("A name that no other item of this list has.")),
            ("kind", json!({ "enum": ["planar", "spatial", "angle", "length"] })),
            ("guess", json!({ "description": guess, "type": "array", "items": named("number") })),
            (
                "preferred",
                json!({
                    "description": "Preferred values of the coordinates of this body, in the order of `guess`; null for a coordinate without preferred value.",
                    "type": "array", "items": { "type": ["number", "string", "null"] },
                }),
            ),
            (
                "length",
                json!({
                    "description": "The distance between the two pins of a link.",
                    "type": ["number", "string", "null"], "exclusiveMinimum": 0,
                }),
            ),
            (
                "between",
                json!({
                    "description": "The two global points between which the initial guess puts a spatial link, if the guess depends on dimensions.",
                    "type": ["array", "null"], "minItems": 2, "maxItems": 2,
                    "items": { "type": "array", "items": named("number"), "minItems": 3, "maxItems": 3 },
                }),
            ),
            (
                "facing",
                json!({
                    "description": "If the initial guess of a spatial body depends on dimensions: its global position, and the global directions of one or two of its axes.",
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
        "A named number. Other numbers of the file can be expressions of dimensions.",
        &["name", "value"],
        &[
            ("name", text("A name that no other item of this list has.")),
            ("value", named("number")),
            ("unit", text("The word for the unit of the dimension.")),
            ("within", json!({ "anyOf": [ends, { "type": "null" }] })),
            ("tolerance", number_or_null("The largest deviation from the value, to either side.")),
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
    let rows = json!({ "type": "array", "items": vector("A row of the inertia tensor."), "minItems": 3, "maxItems": 3 });
    object(
        "The mass, the centre of mass and the inertia tensor of a body. The tensor is about the centre of mass, along the axes of the body.",
        &["body", "mass", "centre", "inertia"],
        &[
            ("body", text("Name of the body.")),
            ("mass", json!({ "type": ["number", "string"], "minimum": 0 })),
            (
                "centre",
                vector(
                    "The centre of mass in the body's frame; in a plane the third component is 0.",
                ),
            ),
            ("inertia", rows),
        ],
    )
}

fn point_mass() -> Value {
    object(
        "A mass at a point. `point` is a function with two or three rows: the global coordinates of the point.",
        &["name", "point", "mass"],
        &[
            ("name", text("A name that no other item of this list has.")),
            ("point", named("scalar")),
            ("mass", json!({ "type": ["number", "string"], "exclusiveMinimum": 0 })),
        ],
    )
}

fn load() -> Value {
    let measure = text("Name of a measure of a joint or of a coordinate, such as guide.slide.");
    let measure =
        object("The measure along which the force acts.", &["measure"], &[("measure", measure)]);
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
        "A load: forces, torques and energies that act under one name.",
        &["name", "parts"],
        &[
            ("name", text("A name that no other item of this list has.")),
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
        ("length", at_least_zero("The length of the bearing of the pin; 0 for a short bearing.")),
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
            ("coefficient", at_least_zero("The coefficient of friction.")),
            ("rate", above_zero("The sliding velocity at which friction reaches its full size.")),
            (
                "pin",
                object(
                    "The dimensions of the pin, for friction in a revolute joint.",
                    &["radius"],
                    &pin,
                ),
            ),
            (
                "slide",
                object(
                    "The dimensions of the guide, for friction in a sliding joint.",
                    &["length", "width"],
                    &slide,
                ),
            ),
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
            (
                "point",
                vector("The point in the body's frame; in a plane the third component is 0."),
            ),
            ("force", laws("Components of the force, as laws of time.")),
            (
                "torque",
                laws(
                    "Components of the torque, as laws of time; in a plane Kin uses only the third component.",
                ),
            ),
            (
                "in_body",
                json!({ "description": "True if the components are along the axes of the body, and false if they are along the global axes.", "type": "boolean" }),
            ),
        ],
    )
}

/// An energy, a length or an angle.
fn scalar() -> Value {
    object(
        "An energy, a length or angle along which a force acts, or a point with mass.",
        &["kind", "arguments"],
        &[
            ("kind", text("Name of the function, in the library or under `equations`.")),
            ("arguments", json!({ "type": "array", "items": named("argument") })),
            (
                "parameters",
                json!({ "description": "The parameters of this function by name.", "type": "object" }),
            ),
        ],
    )
}

/// A function of a length or an angle, its derivative and time.
fn formula() -> Value {
    object(
        "A force that depends on a length or angle, on its velocity and on time.",
        &["kind"],
        &[
            ("kind", text("Name of the function, in the library or under `equations`.")),
            (
                "parameters",
                json!({ "description": "The parameters of this function by name.", "type": "object" }),
            ),
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
        "A constraint, given by its kind, arguments and parameters.",
        &["name", "kind", "arguments"],
        &[
            ("name", text("A name that no other item of this list has.")),
            (
                "kind",
                json!({
                    "description": "Name of the function, in the library or under `equations`.",
                    "anyOf": [{ "enum": kinds }, { "type": "string" }],
                }),
            ),
            (
                "arguments",
                json!({
                    "description": "The bodies and coordinates on which the constraint acts, in the order of the arguments of its function.",
                    "type": "array", "items": named("argument"),
                }),
            ),
            (
                "parameters",
                json!({
                    "description": "The parameters of the constraint by name. A parameter is a number, a list of numbers or a law.", "type": "object",
                }),
            ),
            (
                "lacking",
                json!({
                    "description": "Names that the text of the constraint uses and the file does not contain.",
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
        one("coord", text("The name of a coordinate, such as crank.theta.")),
        one("ground_coord", axis("The index of a coordinate of the ground as a planar body, from 0.")),
        one("spatial_ground_coord", axis("The index of a coordinate of the ground as a spatial body, from 0.")),
    ] })
}

fn law(registry: &Registry) -> Value {
    object(
        "A law, given by its kind or by the text of its function, with the numbers of the law and the laws of which it consists.",
        &[],
        &[
            ("kind", json!({ "anyOf": [{ "enum": registry.law_kinds() }, { "type": "string" }] })),
            (
                "text",
                text(
                    "The text of the law's function for programs that do not know the kind of the law, such as fn lift(x: f64, h: f64) -> f64 { … }.",
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
