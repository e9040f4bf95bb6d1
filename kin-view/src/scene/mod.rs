//! Describes how a mechanism is drawn, from its constraints and from the user's settings.

mod arrow;
mod body;
mod form;
mod outline;

use kin::extend::Attached;
use kin::mechanism::Marker;
use kin::{System, Vec3};

pub(crate) use arrow::{Acting, Arrow};
pub(crate) use body::Kind;
pub use body::{Body, Point};
pub(crate) use form::{Form, Touch};
pub use outline::Outline;
pub(crate) use outline::{OutlineKind, circle};

/// Describes how a mechanism is drawn.
///
/// Kin draws bodies, pins, slots and rods from the points of bodies in the constraints. Methods of
/// the scene replace these shapes or add shapes.
///
/// Kin draws a body through the points at which constraints hold the body, and a link from end to
/// end. A body with one point is a disc, with two points a bar, and with more points a plate. Where
/// points of two bodies coincide at all times, Kin draws a pin. Where a point moves along a path in
/// another body, Kin draws the path as a slot, or as a disc if the path is closed. For a distance
/// between two points Kin draws a rod. Gears, belts, wheels on racks and tracks, cams, and their
/// rollers and faces have the shapes from their joints. A body that rotates about its length has a
/// disc with a spoke. Bodies at rest look like the ground.
///
/// The scene ignores a body of another mechanism and an invalid colour.
#[derive(Clone)]
pub struct Scene {
    pub(crate) name: String,
    pub(crate) looks: Vec<Look>,
    /// The ground; all that is drawn of it is told or of joints.
    pub(crate) ground: Look,
    pub(crate) joints: Vec<Joint>,
    pub(crate) arrows: Vec<Arrow>,
    pub(crate) traces: Vec<Trace>,
    pub(crate) lines: Vec<MovingLine>,
    /// Azimuth and elevation of the eye, where they are told.   [rad]
    pub(crate) eye: Option<(f64, f64)>,
}

/// How one body is drawn.
#[derive(Clone)]
pub(crate) struct Look {
    pub body: Body,
    pub name: String,
    pub color: Option<String>,
    pub hidden: bool,
    /// The length between the pins of a link.
    pub length: Option<f64>,
    /// In place of the default.
    pub outlines: Vec<Outline>,
    /// Beside what is drawn.
    pub added: Vec<Outline>,
}

/// A constraint by the points and directions it speaks of.
#[derive(Clone)]
pub(crate) struct Joint {
    pub name: String,
    /// The bodies of the constraint, including the ground.
    pub bodies: Vec<Body>,
    /// Points as (one of `bodies`, local point).
    pub points: Vec<(usize, Vec3)>,
    /// The ones of `bodies` in which the constraint has a direction.
    pub directed: Vec<usize>,
    /// The shapes of its bodies, as far as the constraint determines them.
    pub form: Option<Form>,
    /// True if Kin does not draw the constraint. Its points still determine the shapes of its
    /// bodies.
    pub hidden: bool,
}

/// A point whose path is shown.
#[derive(Clone)]
pub(crate) struct Trace {
    pub name: String,
    pub body: Body,
    pub local: Vec3,
}

/// A line through points that move, one position a time (or one for good).
#[derive(Clone)]
pub(crate) struct MovingLine {
    pub name: String,
    pub points: Vec<Vec<Vec3>>,
}

impl Scene {
    /// Creates the scene of a mechanism from its bodies and constraints.
    pub fn new(system: &System) -> Scene {
        let looks = system.bodies().into_iter().filter_map(|(name, target)| {
            let body = Body::of(&target)?;
            Some(Look { length: system.link_length(&target), ..Look::new(body, name) })
        });
        let looks = looks.collect();
        let joints = system
            .constraints()
            .filter_map(|(name, constraint)| Joint::new(name, constraint))
            .collect();
        let name = system.name().to_string();
        let eye = None;
        let ground = Look::new(kin::Ground.into(), "ground");
        Scene {
            name,
            looks,
            ground,
            joints,
            arrows: Vec::new(),
            traces: Vec::new(),
            lines: Vec::new(),
            eye,
        }
    }

    /// Draws a body (or the ground) with this outline instead of the default shapes.
    ///
    /// Several calls for a body add several outlines. The default shapes are bars, plates, wheels
    /// and cams.
    pub fn outline(mut self, body: impl Into<Body>, outline: Outline) -> Scene {
        self.look(body.into()).into_iter().for_each(|look| look.outlines.push(outline.clone()));
        self
    }

    /// Draws this outline of a body (or the ground) in addition to its other shapes.
    pub fn add_outline(mut self, body: impl Into<Body>, outline: Outline) -> Scene {
        self.look(body.into()).into_iter().for_each(|look| look.added.push(outline.clone()));
        self
    }

    /// Draws a body in this colour, such as `#0072b2`.
    pub fn color(mut self, body: impl Into<Body>, color: &str) -> Scene {
        let is_color = color.strip_prefix('#').is_some_and(|hex| {
            matches!(hex.len(), 3 | 6) && hex.chars().all(|c| c.is_ascii_hexdigit())
        });
        if let Some(look) = self.look(body.into()).filter(|_| is_color) {
            look.color = Some(color.to_string());
        }
        self
    }

    /// Hides a body. The scene still shows the pins of the body.
    pub fn hide(mut self, body: impl Into<Body>) -> Scene {
        if let Some(look) = self.look(body.into()) {
            look.hidden = true;
        }
        self
    }

    /// Hides the points, slots, rods, wheels and cams of one constraint.
    ///
    /// The shapes of the bodies of the constraint do not change.
    pub fn hide_joint(mut self, name: &str) -> Scene {
        self.joints
            .iter_mut()
            .filter(|joint| joint.name == name)
            .for_each(|joint| joint.hidden = true);
        self
    }

    /// Shows the path of a local point of a body, under a name.
    pub fn trace(mut self, name: &str, body: impl Into<Body>, local: impl Into<Point>) -> Scene {
        self.traces.push(Trace {
            name: name.to_string(),
            body: body.into(),
            local: local.into().0,
        });
        self
    }

    /// Shows the path of a marker, under its name.
    pub fn marker<B: kin::mechanism::Body + Into<Body> + Copy>(self, marker: &Marker<B>) -> Scene
    where
        B::Vector: Into<Point>,
    {
        self.trace(&marker.name, marker.body, marker.u)
    }

    /// Draws a line through points that move, for mechanisms in scalar coordinates.
    ///
    /// Each point has one position for each time of the motion, or a single position if the point
    /// is at rest.
    pub fn line<P: Into<Point> + Copy>(mut self, name: &str, points: &[&[P]]) -> Scene {
        let points =
            points.iter().map(|point| point.iter().map(|p| (*p).into().0).collect()).collect();
        self.lines.push(MovingLine { name: name.to_string(), points });
        self
    }

    /// Sets the direction from which the scene shows a spatial mechanism: the angle about z from
    /// the x-axis, and the angle above the horizon. \[rad\]
    ///
    /// By default the view is perpendicular to the plane of a mechanism that moves in one plane,
    /// and from the side and above for other mechanisms.
    pub fn seen_from(mut self, azimuth: f64, elevation: f64) -> Scene {
        self.eye = Some((azimuth, elevation));
        self
    }

    fn look(&mut self, body: Body) -> Option<&mut Look> {
        if body.is_ground() {
            Some(&mut self.ground)
        } else {
            self.looks.iter_mut().find(|look| look.body == body)
        }
    }
}

impl Look {
    fn new(body: Body, name: &str) -> Look {
        let color = None;
        let outlines = Vec::new();
        let added = Vec::new();
        Look { body, name: name.to_string(), color, hidden: false, length: None, outlines, added }
    }
}

impl Joint {
    /// `None` if it speaks of no point and knows no shape.
    fn new(name: &str, constraint: &dyn kin::Constraint) -> Option<Joint> {
        let arguments = constraint.arguments();
        let bodies = Vec::new();
        let points = Vec::new();
        let directed = Vec::new();
        let mut joint = Joint {
            name: name.to_string(),
            bodies,
            points,
            directed,
            form: Form::of(constraint),
            hidden: false,
        };
        let mut place = vec![None; arguments.len()];
        for (place, argument) in place.iter_mut().zip(&arguments) {
            let Some(body) = Body::of(&argument.target) else { continue };
            *place = Some(joint.bodies.len());
            joint.bodies.push(body);
        }
        for attachment in constraint.attachments() {
            match (attachment.what, place.get(attachment.argument).copied().flatten()) {
                (Attached::Point(u), Some(body))
                    if u.x.is_finite() && u.y.is_finite() && u.z.is_finite() =>
                {
                    joint.points.push((body, u))
                }
                (Attached::Direction(_), Some(body)) => joint.directed.push(body),
                _ => {}
            }
        }
        (!joint.points.is_empty() || joint.form.is_some()).then_some(joint)
    }
}
