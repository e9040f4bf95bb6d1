//! Determines the symbols of joints (pins, slots, rods) from the motion of their points.

use kin::{Vec2, Vec3, vec2};

use super::track::{Frame, Track};
use crate::scene::Form;

/// A joint by its points, on tracks.
pub(crate) struct Held {
    /// The bodies of the constraint, as tracks.
    pub tracks: Vec<usize>,
    /// Points as (track, local point).
    pub points: Vec<(usize, Vec3)>,
    /// Tracks of bodies in which the constraint has a direction.
    pub directed: Vec<usize>,
    /// The shapes of its bodies, as far as the constraint determines them.
    pub form: Option<Form>,
    /// True if nothing of the constraint is drawn.
    pub hidden: bool,
}

/// How it is drawn.
#[derive(Default)]
pub(crate) struct Drawn {
    /// Points to be marked, as (track, local point).
    pub marks: Vec<(usize, Vec3)>,
    /// The path of a point in another body.
    pub slot: Option<Slot>,
    /// Two points at a distance.
    pub rod: Option<[(usize, Vec3); 2]>,
}

pub(crate) struct Slot {
    /// In the frame of this track.
    pub track: usize,
    pub path: Vec<Vec3>,
    /// The point that runs in it, as (track, local point).
    pub runner: (usize, Vec3),
    pub straight: bool,
    /// True if the runner does not turn in it.
    pub guided: bool,
}

/// Frames of all tracks at some times.
pub(crate) struct Samples {
    frames: Vec<Vec<Frame>>,
    size: f64,
}

impl Samples {
    pub fn new(tracks: &[Track], times: &[usize], size: f64) -> Samples {
        Samples {
            frames: tracks
                .iter()
                .map(|track| times.iter().map(|&k| track.frame(k)).collect())
                .collect(),
            size,
        }
    }

    /// Returns the number of samples.
    pub fn len(&self) -> usize {
        self.frames.first().map_or(0, Vec::len)
    }

    /// Returns the frame of a track at a sample.
    pub fn frame(&self, track: usize, k: usize) -> Option<Frame> {
        self.frames[track].get(k).copied()
    }

    /// Returns the positions of a point at all samples.
    pub fn path(&self, (track, local): (usize, Vec3)) -> impl Iterator<Item = Vec3> + '_ {
        self.frames[track].iter().map(move |frame| frame.point(local))
    }

    /// Returns true if two points coincide at all samples.
    pub fn together(&self, a: (usize, Vec3), b: (usize, Vec3)) -> bool {
        self.path(a).zip(self.path(b)).all(|(a, b)| (a - b).norm() <= 1e-6 * self.size)
    }

    /// Returns the path of a point relative to the body of a track.
    pub fn relative(&self, point: (usize, Vec3), track: usize) -> Vec<Vec3> {
        self.path(point).zip(&self.frames[track]).map(|(p, frame)| frame.local(p)).collect()
    }

    /// Returns the first position of a point relative to the body of a track, in the plane.
    pub fn seen(&self, point: (usize, Vec3), track: usize) -> Vec2 {
        let first = self.relative(point, track).into_iter().find(|p| p.norm().is_finite());
        first.map_or(vec2(f64::NAN, f64::NAN), |p| vec2(p.x, p.y))
    }

    /// Returns true if a point never moves relative to the body of a track.
    pub fn stays(&self, point: (usize, Vec3), track: usize) -> bool {
        let path = self.relative(point, track);
        path.iter().all(|p| (*p - path[0]).norm() <= 1e-6 * self.size)
    }

    /// True if track a does not turn as track b sees it.
    fn turns_with(&self, a: usize, b: usize) -> bool {
        let x = Vec3::new(1.0, 0.0, 0.0);
        let mut seen =
            self.frames[a].iter().zip(&self.frames[b]).map(|(a, b)| b.a.transpose() * (a.a * x));
        seen.next().is_none_or(|first| seen.all(|h| (h - first).norm() < 1e-6))
    }

    /// Determines how a joint is drawn; `still` says which tracks never move.
    pub fn drawn(&self, joint: &Held, still: &[bool]) -> Drawn {
        let points = &joint.points;
        let alone = |k: usize| {
            !(0..points.len())
                .any(|l| points[l].0 != points[k].0 && self.together(points[k], points[l]))
        };
        let lonely: Vec<(usize, Vec3)> =
            (0..points.len()).filter(|&k| alone(k)).map(|k| points[k]).collect();
        let mut drawn = Drawn { marks: points.clone(), ..Drawn::default() };
        if lonely.len() < points.len() || joint.form.is_some() {
            return drawn;
        }
        drawn.slot = self.slot(joint, still);
        if let Some(slot) = &drawn.slot {
            drawn.marks = if slot.guided && slot.straight { vec![] } else { vec![slot.runner] };
        } else if let ([a, b], []) = (&lonely[..], &joint.directed[..])
            && a.0 != b.0
        {
            drawn.rod = Some([*a, *b]);
        }
        drawn
    }

    /// The straightest of the paths that a point of one body draws in the other; of equals that in
    /// a body that stands still.
    fn slot(&self, joint: &Held, still: &[bool]) -> Option<Slot> {
        let [a, b] = joint.tracks[..] else { return None };
        let point_of =
            |track: usize| joint.points.iter().copied().find(|(known, _)| *known == track);
        let origin = |track: usize| {
            joint.directed.contains(&track).then_some((track, Vec3::new(0.0, 0.0, 0.0)))
        };
        let is_rod = joint.directed.is_empty() && point_of(a).is_some() && point_of(b).is_some();
        let made = |track: usize, other: usize| {
            let runner = point_of(other).or(origin(other))?;
            let path = self.relative(runner, track);
            let (extent, bend) = shape(&path)?;
            let straight = bend < 1e-3 * extent;
            (extent > 1e-4 * self.size).then(|| Slot {
                track,
                path,
                runner,
                straight,
                guided: self.turns_with(other, track),
            })
        };
        let mut all: Vec<Slot> =
            [made(a, b), made(b, a)].into_iter().flatten().filter(|_| !is_rod).collect();
        all.sort_by_key(|slot| {
            (!slot.straight, !still[slot.track], !joint.directed.contains(&slot.track))
        });
        all.into_iter().next()
    }
}

/// The length of a path's longest chord from its start, and how far it strays from it; `None` where
/// it is not known.
fn shape(path: &[Vec3]) -> Option<(f64, f64)> {
    let first = *path.first()?;
    let far =
        path.iter().copied().max_by(|a, b| (*a - first).norm().total_cmp(&(*b - first).norm()))?;
    let end =
        path.iter().copied().max_by(|a, b| (*a - far).norm().total_cmp(&(*b - far).norm()))?;
    let chord = far - end;
    let extent = chord.norm();
    let off = |p: &Vec3| (*p - end).cross(chord).norm() / extent.max(f64::MIN_POSITIVE);
    extent.is_finite().then(|| (extent, path.iter().map(off).fold(0.0, f64::max)))
}

/// True if a path in the plane encloses something: it ends where it began, and has an area.
pub(crate) fn is_closed(path: &[Vec3]) -> bool {
    let (Some(first), Some(last), Some((extent, _))) = (path.first(), path.last(), shape(path))
    else {
        return false;
    };
    let area: f64 = path.windows(2).map(|w| 0.5 * (w[0].x * w[1].y - w[0].y * w[1].x)).sum();
    (*last - *first).norm() < 0.02 * extent && area.abs() > 0.05 * extent * extent
}
