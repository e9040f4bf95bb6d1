//! Converts coordinates of the mechanism to coordinates of the picture.

use kin::{Vec2, Vec3, vec2};

use crate::drawing::Drawing;

/// Room round the mechanism.   [px]
const MARGIN: f64 = 28.0;

/// Where the eye is, and how large things appear.
pub(super) struct View {
    right: Vec3,
    up: Vec3,
    eye: Vec3,
    /// Pixels a unit of length.
    pub scale: f64,
    shift: Vec2,
    pub width: f64,
    pub height: f64,
}

impl View {
    /// Creates a view that shows the whole drawing at all times within a width and a height. [px]
    pub fn new(drawing: &Drawing, width: f64, height: f64) -> View {
        let [right, up, eye] = axes(drawing);
        let mut low = vec2(f64::MAX, f64::MAX);
        let mut high = vec2(f64::MIN, f64::MIN);
        for corner in corners(&drawing.bounds) {
            let p = vec2(right.dot(corner), up.dot(corner));
            low = vec2(low.x.min(p.x), low.y.min(p.y));
            high = vec2(high.x.max(p.x), high.y.max(p.y));
        }
        let wide = high.x - low.x;
        let tall = high.y - low.y;
        let least = drawing.size * 1e-3;
        let scale = ((width - 2.0 * MARGIN) / wide.max(least))
            .min((height - 2.0 * MARGIN) / tall.max(least));
        let width = (wide * scale + 2.0 * MARGIN).max(240.0);
        let height = (tall * scale + 2.0 * MARGIN).max(160.0);
        // Half of each first: their sum may be too large.
        let middle = low * 0.5 + high * 0.5;
        View {
            right,
            up,
            eye,
            scale,
            shift: vec2(0.5 * width - scale * middle.x, 0.5 * height + scale * middle.y),
            width,
            height,
        }
    }

    /// Returns the position of a point in the picture. [px]
    pub fn point(&self, p: Vec3) -> Vec2 {
        vec2(
            self.shift.x + self.scale * self.right.dot(p),
            self.shift.y - self.scale * self.up.dot(p),
        )
    }

    /// Returns the depth of a point: how close the point is to the viewer.
    pub fn depth(&self, p: Vec3) -> f64 {
        self.eye.dot(p)
    }

    /// Returns the lines of a floor under a spatial mechanism.
    pub fn floor(&self, drawing: &Drawing) -> Vec<Vec<Vec2>> {
        // Seen from right above a floor is no floor.
        if drawing.planar || self.eye.z.abs() > 0.999 {
            return Vec::new();
        }
        let [low, high] = drawing.bounds;
        const LINES: usize = 8;
        let share = |a: f64, b: f64, k: usize| a + (b - a) * k as f64 / LINES as f64;
        let line = |a: Vec3, b: Vec3| vec![self.point(a), self.point(b)];
        let along_y = (0..=LINES)
            .map(|k| share(low.x, high.x, k))
            .map(|x| line(Vec3::new(x, low.y, low.z), Vec3::new(x, high.y, low.z)));
        let along_x = (0..=LINES)
            .map(|k| share(low.y, high.y, k))
            .map(|y| line(Vec3::new(low.x, y, low.z), Vec3::new(high.x, y, low.z)));
        along_y.chain(along_x).collect()
    }
}

/// Axes of the view: to the right, upwards, and to the eye.
fn axes(drawing: &Drawing) -> [Vec3; 3] {
    if drawing.planar {
        return [Vec3::x(), Vec3::y(), Vec3::z()];
    }
    let (sin, cos) = drawing.eye.0.sin_cos();
    let (high, flat) = drawing.eye.1.sin_cos();
    let eye = Vec3::new(flat * cos, flat * sin, high);
    let right = Vec3::new(-sin, cos, 0.0);
    [right, eye.cross(right), eye]
}

fn corners([low, high]: &[Vec3; 2]) -> impl Iterator<Item = Vec3> {
    let pick = |k: usize, bit: usize, a: f64, b: f64| if k >> bit & 1 == 0 { a } else { b };
    (0..8).map(move |k| {
        Vec3::new(pick(k, 0, low.x, high.x), pick(k, 1, low.y, high.y), pick(k, 2, low.z, high.z))
    })
}
