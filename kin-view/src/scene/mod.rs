//! How a mechanism is to be drawn: what its constraints say by themselves, and what the user tells.

mod body;
mod outline;

use kin::{Attached, Marker, System, Vec3};

pub(crate) use body::Kind;
pub use body::{Body, Point};
pub use outline::Outline;
pub(crate) use outline::circle;

/// How a mechanism is drawn. Bodies, pins, slots and rods come from the mechanism itself: each constraint knows the points of its bodies
/// that it speaks of. What is told here comes on top, or instead.
///
/// A body is drawn through the points where constraints hold it: one point is a disc, two are a bar, more are a plate. Where points of two
/// bodies stay together there is a pin; where a point runs along a path in another body, that path is drawn as a slot (or, if it is closed,
/// as a disc of that shape); two points without a direction between them are held by a rod. Bodies that stand still look like the ground.
///
/// A told body of another mechanism, and a colour that is none, change nothing.
#[derive(Clone)]
pub struct Scene {
    pub(crate) name: String,
    pub(crate) looks: Vec<Look>,
    pub(crate) ground: Vec<Outline>,
    pub(crate) joints: Vec<Joint>,
    pub(crate) traces: Vec<Trace>,
    pub(crate) lines: Vec<MovingLine>,
    /// Azimuth and elevation of the eye.   [rad]
    pub(crate) eye: (f64, f64),
}

/// How one body is drawn.
#[derive(Clone)]
pub(crate) struct Look {
    pub body: Body,
    pub name: String,
    pub color: Option<String>,
    pub hidden: bool,
    /// In place of the default.
    pub outlines: Vec<Outline>,
}

/// A constraint by the points and directions it speaks of.
#[derive(Clone)]
pub(crate) struct Joint {
    pub name: String,
    /// Its bodies; the ground too.
    pub bodies: Vec<Body>,
    /// Points as (one of `bodies`, local point).
    pub points: Vec<(usize, Vec3)>,
    /// Those of `bodies` that it speaks of a direction of.
    pub directed: Vec<usize>,
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
    /// The mechanism as its bodies and constraints describe it.
    pub fn new(system: &System) -> Scene {
        let looks = system.bodies().into_iter().filter_map(|(name, target)| {
            let body = Body::of(&target)?;
            Some(Look { body, name: name.to_string(), color: None, hidden: false, outlines: Vec::new() })
        });
        let looks = looks.collect();
        let joints = system.constraints().filter_map(|(name, constraint)| Joint::new(name, constraint)).collect();
        let (name, eye) = (system.name().to_string(), (-1.05, 0.35));
        Scene { name, looks, ground: Vec::new(), joints, traces: Vec::new(), lines: Vec::new(), eye }
    }

    /// Draws a body (or the ground) by this outline; several add up. It takes the place of the default.
    pub fn outline(mut self, body: impl Into<Body>, outline: Outline) -> Scene {
        let body = body.into();
        if body.is_ground() {
            self.ground.push(outline);
        } else if let Some(look) = self.look(body) {
            look.outlines.push(outline);
        }
        self
    }

    /// Draws a body in this colour, such as `#0072b2`.
    pub fn color(mut self, body: impl Into<Body>, color: &str) -> Scene {
        let is_color = color.strip_prefix('#').is_some_and(|hex| matches!(hex.len(), 3 | 6) && hex.chars().all(|c| c.is_ascii_hexdigit()));
        if let Some(look) = self.look(body.into()).filter(|_| is_color) {
            look.color = Some(color.to_string());
        }
        self
    }

    /// Does not draw a body; its pins stay.
    pub fn hide(mut self, body: impl Into<Body>) -> Scene {
        if let Some(look) = self.look(body.into()) {
            look.hidden = true;
        }
        self
    }

    /// Does not draw the points, slots and rods of one constraint.
    pub fn hide_joint(mut self, name: &str) -> Scene {
        self.joints.retain(|joint| joint.name != name);
        self
    }

    /// Shows the path of a local point of a body, under a name.
    pub fn trace(mut self, name: &str, body: impl Into<Body>, local: impl Into<Point>) -> Scene {
        self.traces.push(Trace { name: name.to_string(), body: body.into(), local: local.into().0 });
        self
    }

    /// Shows the path of a marker, under its name.
    pub fn marker<B: kin::motion::Body + Into<Body> + Copy>(self, marker: &Marker<B>) -> Scene
    where
        B::Vector: Into<Point>,
    {
        self.trace(&marker.name, marker.body, marker.u)
    }

    /// Draws a line through points that move, for mechanisms of bare coordinates: for each point its position at each time of the motion,
    /// or a single one if it stays.
    pub fn line<P: Into<Point> + Copy>(mut self, name: &str, points: &[&[P]]) -> Scene {
        let points = points.iter().map(|point| point.iter().map(|p| (*p).into().0).collect()).collect();
        self.lines.push(MovingLine { name: name.to_string(), points });
        self
    }

    /// Where the eye stands that looks at a spatial mechanism: angle about z from the x-axis, and above the horizon.   \[rad\]
    pub fn seen_from(mut self, azimuth: f64, elevation: f64) -> Scene {
        self.eye = (azimuth, elevation);
        self
    }

    fn look(&mut self, body: Body) -> Option<&mut Look> {
        self.looks.iter_mut().find(|look| look.body == body)
    }
}

impl Joint {
    /// `None` if it speaks of no point.
    fn new(name: &str, constraint: &dyn kin::Constraint) -> Option<Joint> {
        let arguments = constraint.arguments();
        let mut joint = Joint { name: name.to_string(), bodies: Vec::new(), points: Vec::new(), directed: Vec::new() };
        let mut place = vec![None; arguments.len()];
        for (place, argument) in place.iter_mut().zip(&arguments) {
            let Some(body) = Body::of(&argument.target) else { continue };
            *place = Some(joint.bodies.len());
            joint.bodies.push(body);
        }
        for attachment in constraint.attachments() {
            match (attachment.what, place.get(attachment.argument).copied().flatten()) {
                (Attached::Point(u), Some(body)) if u.x.is_finite() && u.y.is_finite() && u.z.is_finite() => joint.points.push((body, u)),
                (Attached::Direction(_), Some(body)) => joint.directed.push(body),
                _ => {}
            }
        }
        (!joint.points.is_empty()).then_some(joint)
    }
}
