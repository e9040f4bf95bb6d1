//! Creates the drawing of a scene and a motion: shapes fixed in tracks, lines between tracks,
//! marks, traces.

mod arrows;
mod bodies;
mod forms;
mod hull;
mod joints;
mod track;
mod turns;
mod wheels;

use kin::results::Units;
use kin::{Motion, Result, Vec3};

use crate::color::PALETTE;
use crate::scene::{Look, Outline, OutlineKind, Scene};
pub(crate) use arrows::{Push, Scale, round_below};
use hull::covers;
use joints::{Held, Samples};
pub(crate) use track::Track;
pub(crate) use turns::LEAP;

/// Everything to be drawn.
pub(crate) struct Drawing {
    pub name: String,
    /// True if all points lie in the plane z = 0.
    pub planar: bool,
    pub times: Vec<f64>,
    /// By how much a body turns at most from each time to the next.   [rad]
    pub turns: Vec<f64>,
    /// Names of the units of length and time.
    pub units: Units,
    pub tracks: Vec<Track>,
    pub shapes: Vec<Shape>,
    /// Lines through points of several tracks.
    pub lines: Vec<Line>,
    pub marks: Vec<Mark>,
    pub traces: Vec<Mark>,
    /// Least and greatest coordinates of all at all times.
    pub bounds: [Vec3; 2],
    /// Diagonal of the bounds: line widths and the like are shares of it.
    pub size: f64,
    pub eye: (f64, f64),
    /// Forces and torques, how each of the two is drawn, and the longest arrow.
    pub pushes: Vec<Push>,
    pub scales: [Scale; 2],
    pub longest: f64,
}

/// A shape fixed in a track.
pub(crate) struct Shape {
    pub name: String,
    pub track: usize,
    pub points: Vec<Vec3>,
    pub style: Style,
    pub color: String,
}

#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub(crate) enum Style {
    /// Filled, with an edge.
    Plate,
    /// A thick line.
    Bar,
    /// A thin line on a body.
    Slot,
    /// A thin line on the ground.
    Guide,
}

/// A straight line through points of several tracks.
pub(crate) struct Line {
    pub name: String,
    pub points: Vec<(usize, Vec3)>,
    pub color: String,
    pub kind: LineKind,
}

#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub(crate) enum LineKind {
    Outline,
    /// Between two points that a constraint holds at a distance.
    Rod,
    /// The thick end of a rod whose length changes.
    Barrel,
}

impl LineKind {
    /// Returns the width of the line. [px]
    pub fn width(self) -> f64 {
        if self == LineKind::Barrel { 9.0 } else { 3.5 }
    }
}

/// A marked point, or one whose path is shown.
pub(crate) struct Mark {
    pub name: String,
    pub track: usize,
    pub local: Vec3,
    pub color: String,
    /// True for a support, which is at rest, independently of its body.
    pub grounded: bool,
}

/// Colour of bodies that stand still.
pub(crate) const GROUND: &str = "#808080";
/// Where the eye stands where nobody says.   [rad]
const USUAL_EYE: (f64, f64) = (-1.05, 0.35);
/// Rods and other lines of no body.
const ROD: &str = "#5a5a5a";

/// Joints are judged, and bounds taken, at this many times.
const SAMPLES: usize = 720;

impl Drawing {
    /// Creates the drawing of a motion.
    ///
    /// Errors: the motion belongs to another system.
    pub fn new(scene: &Scene, motion: &Motion) -> Result<Drawing> {
        let mut tracks = vec![Track::Ground];
        for look in &scene.looks {
            tracks.push(Track::of(motion, look.body)?);
        }
        let mut drawing = Drawing {
            name: scene.name.clone(),
            planar: true,
            times: motion.times().to_vec(),
            turns: turns::turns(scene, motion)?,
            units: motion.unit_words().clone(),
            shapes: Vec::new(),
            lines: moving_lines(scene, &mut tracks, motion.len()),
            marks: Vec::new(),
            traces: Vec::new(),
            bounds: [Vec3::new(0.0, 0.0, 0.0); 2],
            size: 1.0,
            eye: scene.eye.unwrap_or(USUAL_EYE),
            pushes: Vec::new(),
            scales: Default::default(),
            longest: 0.0,
            tracks,
        };
        drawing.planar = !drawing.tracks.iter().any(|track| matches!(track, Track::Spatial(_)))
            && !drawing.leaves_plane();
        drawing.traces = drawing.traced(scene);
        let held = drawing.held(scene);
        drawing.measure(&held, scene);
        drawing.draw(scene, &held);
        drawing.measure_shapes();
        if scene.eye.is_none() && !drawing.planar {
            drawing.eye = drawing.face().unwrap_or(USUAL_EYE);
        }
        drawing.push(scene, motion);
        Ok(drawing)
    }

    /// Times at which joints are judged.
    fn sampled(&self) -> Vec<usize> {
        let n = self.times.len();
        let step = n.div_ceil(SAMPLES).max(1);
        let last = n.checked_sub(1).filter(|last| last % step != 0);
        (0..n).step_by(step).chain(last).collect()
    }

    fn samples(&self) -> Samples {
        Samples::new(&self.tracks, &self.sampled(), self.size)
    }

    /// True if a moving line has a point off the plane z = 0.
    fn leaves_plane(&self) -> bool {
        self.tracks.iter().any(
            |track| matches!(track, Track::Point([_, _, z]) if z.iter().any(|z| z.abs() > 0.0)),
        )
    }

    /// The track of a body.
    fn track(&self, scene: &Scene, body: crate::scene::Body) -> Option<usize> {
        if body.is_ground() {
            Some(0)
        } else {
            scene.looks.iter().position(|look| look.body == body).map(|k| k + 1)
        }
    }

    fn traced(&self, scene: &Scene) -> Vec<Mark> {
        let traces =
            scene.traces.iter().filter_map(|trace| Some((trace, self.track(scene, trace.body)?)));
        let marks = traces.enumerate().map(|(k, (trace, track))| Mark {
            name: trace.name.clone(),
            track,
            local: trace.local,
            color: PALETTE[(k + 3) % PALETTE.len()].to_string(),
            grounded: false,
        });
        marks.collect()
    }

    /// The joints, on tracks.
    fn held(&self, scene: &Scene) -> Vec<(String, Held)> {
        let joints = scene.joints.iter().filter_map(|joint| {
            let tracks: Vec<usize> =
                joint.bodies.iter().map(|body| self.track(scene, *body)).collect::<Option<_>>()?;
            let points = joint.points.iter().map(|(body, u)| (tracks[*body], *u)).collect();
            let directed = joint.directed.iter().map(|body| tracks[*body]).collect();
            let form = joint.form.clone();
            let hidden = joint.hidden;
            Some((joint.name.clone(), Held { tracks, points, directed, form, hidden }))
        });
        joints.collect()
    }

    /// Size from what is held, told and traced.
    fn measure(&mut self, held: &[(String, Held)], scene: &Scene) {
        let mut all: Vec<(usize, Vec3)> =
            held.iter().flat_map(|(_, joint)| joint.points.iter().copied()).collect();
        all.extend(self.traces.iter().map(|trace| (trace.track, trace.local)));
        all.extend(self.lines.iter().flat_map(|line| line.points.iter().copied()));
        let told = |look: &Look, track: usize| {
            let outlines = look.outlines.iter().chain(&look.added);
            outlines.flat_map(|outline| &outline.points).map(|p| (track, *p)).collect::<Vec<_>>()
        };
        all.extend(told(&scene.ground, 0));
        for (k, look) in scene.looks.iter().enumerate() {
            all.push((k + 1, Vec3::new(0.0, 0.0, 0.0)));
            all.extend(told(look, k + 1));
            all.extend(link_ends(look).map(|p| (k + 1, p)));
        }
        self.set_bounds(&all);
    }

    /// Bounds of everything that is drawn.
    fn measure_shapes(&mut self) {
        let shapes =
            self.shapes.iter().flat_map(|shape| shape.points.iter().map(|p| (shape.track, *p)));
        let marks = self.marks.iter().chain(&self.traces).map(|mark| (mark.track, mark.local));
        let lines = self.lines.iter().flat_map(|line| line.points.iter().copied());
        let all: Vec<(usize, Vec3)> = shapes.chain(marks).chain(lines).collect();
        self.set_bounds(&all);
    }

    fn set_bounds(&mut self, points: &[(usize, Vec3)]) {
        let samples = self.samples();
        let far = Vec3::new(f64::MAX, f64::MAX, f64::MAX);
        let mut low = far;
        let mut high = -far;
        for p in
            points.iter().flat_map(|point| samples.path(*point)).filter(|p| p.norm().is_finite())
        {
            low = Vec3::new(low.x.min(p.x), low.y.min(p.y), low.z.min(p.z));
            high = Vec3::new(high.x.max(p.x), high.y.max(p.y), high.z.max(p.z));
        }
        let size = (high - low).norm();
        if low.x > high.x || !(size > 0.0 && size.is_finite()) {
            let half = Vec3::new(0.5, 0.5, 0.0);
            let middle = if low.x > high.x { Vec3::new(0.0, 0.0, 0.0) } else { low };
            (low, high) = (middle - half, middle + half);
        }
        self.bounds = [low, high];
        self.size = (high - low).norm();
    }

    fn draw(&mut self, scene: &Scene, held: &[(String, Held)]) {
        self.draw_all(scene, held);
        self.let_plates_carry(&scene.ground);
    }

    fn draw_all(&mut self, scene: &Scene, held: &[(String, Held)]) {
        let samples = self.samples();
        // At one time alone nothing can be said of what stands still but the ground.
        let stands = |track: &Track| {
            self.times.len() > 1 && track.is_still(1e-9 * self.size)
                || matches!(track, Track::Ground)
        };
        let still: Vec<bool> = self.tracks.iter().map(stands).collect();
        let shown = held.iter().filter(|(_, joint)| !joint.hidden);
        let drawn: Vec<_> =
            shown.map(|(name, joint)| (name, samples.drawn(joint, &still))).collect();
        self.draw_bodies(scene, held, &drawn, &still, forms::pieces(held, &samples));
        for (name, joint) in &drawn {
            if let Some(rod) = &joint.rod {
                self.draw_rod(name, *rod);
            }
            for &(track, local) in &joint.marks {
                self.mark(&samples, name, (track, local), still[track]);
            }
        }
        let told = self.lines.iter().filter(|line| line.kind == LineKind::Outline);
        let mut ends: Vec<(bool, String, (usize, Vec3))> = Vec::new();
        for line in told {
            let last = line.points.len().saturating_sub(1);
            ends.extend(
                line.points
                    .iter()
                    .enumerate()
                    .map(|(k, point)| (k != last, line.name.clone(), *point)),
            );
        }
        // The last point has the name of its line, also where another line begins there.
        ends.sort_by_key(|(begins, ..)| *begins);
        for (begins, name, point) in ends {
            self.mark(
                &samples,
                &if begins { format!("{name}, start") } else { name },
                point,
                still[point.0],
            );
        }
    }

    /// A pin on a plate that the ground is told to be needs no support.
    fn let_plates_carry(&mut self, ground: &Look) {
        let plates: Vec<&Outline> = ground
            .outlines
            .iter()
            .chain(&ground.added)
            .filter(|outline| outline.kind == OutlineKind::Filled)
            .collect();
        for mark in self.marks.iter_mut().filter(|mark| mark.grounded) {
            let p = self.tracks[mark.track].frame(0).point(mark.local);
            mark.grounded = !plates.iter().any(|plate| covers(&plate.points, p));
        }
    }

    /// A rod between two points; where their distance changes, as a cylinder: a barrel on the body
    /// that comes first, and the rod in it.
    fn draw_rod(&mut self, name: &str, rod: [(usize, Vec3); 2]) {
        /// How much of a cylinder the barrel is: a share of its least length, and of its greatest.
        const BARREL: [f64; 2] = [0.92, 0.7];
        let [from, to] = if rod[0].0 <= rod[1].0 { rod } else { [rod[1], rod[0]] };
        let ends = |k: usize| [from, to].map(|(track, p)| self.tracks[track].frame(k).point(p));
        let lengths = (0..self.times.len())
            .map(|k| (ends(k)[1] - ends(k)[0]).norm())
            .filter(|length| length.is_finite());
        let (least, most) =
            lengths.fold((f64::MAX, f64::MIN), |(low, high), x| (low.min(x), high.max(x)));
        let line = |points: Vec<(usize, Vec3)>, kind: LineKind| Line {
            name: name.to_string(),
            points,
            color: ROD.to_string(),
            kind,
        };
        self.lines.push(line(vec![from, to], LineKind::Rod));
        if most - least <= 1e-6 * self.size {
            return;
        }
        let barrel = (BARREL[0] * least).min(BARREL[1] * most);
        let mouth = |k: usize| {
            let [a, b] = ends(k);
            a + (b - a) * (barrel / (b - a).norm())
        };
        let mouths: Vec<Vec3> = (0..self.times.len()).map(mouth).collect();
        self.tracks.push(Track::of_point(&mouths, self.times.len()));
        let mouth = (self.tracks.len() - 1, Vec3::new(0.0, 0.0, 0.0));
        self.lines.push(line(vec![from, mouth], LineKind::Barrel));
    }

    /// Marks a point, unless one is marked that is always there; a support takes the place of a
    /// pin.
    fn mark(&mut self, samples: &Samples, name: &str, point: (usize, Vec3), grounded: bool) {
        match self.marks.iter_mut().find(|mark| samples.together((mark.track, mark.local), point)) {
            Some(mark) => {
                mark.grounded |= grounded;
                // The pin is drawn with the upper one of its bodies.
                if point.0 > mark.track {
                    (mark.track, mark.local) = point;
                }
            }
            None => {
                self.marks.push(Mark {
                    name: name.to_string(),
                    track: point.0,
                    local: point.1,
                    color: ROD.to_string(),
                    grounded,
                });
            }
        }
    }
}

/// The ends of a link in its frame; of other bodies none.
fn link_ends(look: &Look) -> impl Iterator<Item = Vec3> {
    look.length
        .into_iter()
        .flat_map(|length| [-0.5, 0.5].map(|share| Vec3::new(share * length, 0.0, 0.0)))
}

/// Told lines, with a track for each of their points.
fn moving_lines(scene: &Scene, tracks: &mut Vec<Track>, times: usize) -> Vec<Line> {
    let lines = scene.lines.iter().enumerate().map(|(k, line)| {
        let points = line.points.iter().map(|positions| {
            tracks.push(Track::of_point(positions, times));
            (tracks.len() - 1, Vec3::new(0.0, 0.0, 0.0))
        });
        Line {
            name: line.name.clone(),
            points: points.collect(),
            color: PALETTE[k % PALETTE.len()].to_string(),
            kind: LineKind::Outline,
        }
    });
    lines.collect()
}
