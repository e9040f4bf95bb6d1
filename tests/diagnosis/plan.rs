//! Planar mechanisms as lists, to be built in other units, orders and places.

use kin::diagnosis::{Class, Diagnosis, Level};
use kin::prelude::*;

#[derive(Clone, Copy, Debug)]
pub enum Joint {
    /// A pin between two links (`None`: the ground) at local points.
    Pin(Option<usize>, usize, [f64; 2], [f64; 2]),
    /// The angle of a link at t = 0, and its rate.
    Motor(usize, f64, f64),
}

#[derive(Clone, Debug)]
pub struct Plan {
    pub links: Vec<(String, [f64; 3])>,
    pub joints: Vec<(String, Joint)>,
}

/// Unit, placement and order of declaration, which change nothing.
#[derive(Clone, Debug)]
pub struct View {
    /// The unit of length.
    pub unit: f64,
    /// The whole is turned, then moved.
    pub turn: f64,
    pub shift: [f64; 2],
    /// Numbers by which links and joints are sorted before they are declared.
    pub order: Vec<u64>,
}

impl View {
    pub fn plain() -> View {
        View { unit: 1.0, turn: 0.0, shift: [0.0, 0.0], order: vec![0] }
    }

    fn point(&self, [x, y]: [f64; 2]) -> [f64; 2] {
        let (s, c) = self.turn.sin_cos();
        [self.unit * (c * x - s * y + self.shift[0]), self.unit * (s * x + c * y + self.shift[1])]
    }

    fn sorted<T>(&self, all: impl IntoIterator<Item = T>) -> Vec<T> {
        let mut keyed: Vec<(u64, T)> = all
            .into_iter()
            .enumerate()
            .map(|(k, item)| (self.order[k % self.order.len()], item))
            .collect();
        keyed.sort_by_key(|(key, _)| *key);
        keyed.into_iter().map(|(_, item)| item).collect()
    }
}

impl Plan {
    pub fn mechanism(&self, view: &View) -> Mechanism {
        let mut m = Mechanism::new("plan");
        let mut bodies: Vec<Option<PlanarBody>> = vec![None; self.links.len()];
        for (k, (name, [x, y, theta])) in view.sorted(self.links.iter().enumerate()) {
            let [x, y] = view.point([*x, *y]);
            bodies[k] = Some(m.planar(name, pose(x, y, theta + view.turn)).unwrap());
        }
        let body = |k: usize| bodies[k].unwrap();
        let local = |[x, y]: [f64; 2]| vec2(view.unit * x, view.unit * y);
        for (name, joint) in view.sorted(&self.joints) {
            match *joint {
                Joint::Pin(Some(i), j, u_i, u_j) => {
                    m.add(name, revolute(body(i), body(j), local(u_i), local(u_j))).unwrap()
                }
                Joint::Pin(None, j, p, u_j) => {
                    let [x, y] = view.point(p);
                    m.add(name, revolute(m.ground(), body(j), vec2(x, y), local(u_j))).unwrap()
                }
                Joint::Motor(k, angle, rate) => {
                    m.add(name, drive_angle(body(k), Law::linear(angle + view.turn, rate))).unwrap()
                }
            };
        }
        m
    }
}

/// All of a verdict that must not depend on how a mechanism is looked at.
pub fn verdict(found: &Diagnosis) -> Vec<String> {
    let mut all = vec![
        format!(
            "{} {} {} {} {}",
            found.coordinates, found.equations, found.rank, found.nearby_rank, found.mobility
        ),
        format!(
            "moves {} misleads {} driven {}",
            found.moves,
            found.count_misleads(),
            found.can_be_driven()
        ),
    ];
    let mut lines: Vec<String> = Vec::new();
    for dependency in &found.dependencies {
        let mut names = dependency.constraints();
        let own = names[0];
        names.sort_unstable();
        let class = match dependency.class {
            Class::Contradictory { level: Level::Position, .. } => "position".to_string(),
            Class::Contradictory { level, .. } => format!("{level:?}"),
            class => format!("{class:?}"),
        };
        lines.push(format!("{class} {own} in {names:?}"));
    }
    for freedom in &found.freedoms {
        let mut names: Vec<&String> =
            freedom.motions.iter().flat_map(|motion| &motion.names).collect();
        names.sort();
        lines.push(format!("{:?} {names:?}", freedom.persistence));
    }
    lines.extend(found.gaps.iter().map(|gap| format!("gap at {} {}", gap.constraint, gap.lasting)));
    lines.sort();
    all.extend(lines);
    all
}

/// Three cranks and a coupler; the third is `third` long.
pub fn three_cranks(third: f64, motors: &[Joint]) -> Plan {
    let angle = 1.0_f64;
    let c = angle.cos();
    let s = angle.sin();
    let pivots = [[0.0, 0.0], [2.0, 0.0], [0.8, -0.5]];
    let mut links = Vec::new();
    let mut joints = Vec::new();
    for (k, pivot) in pivots.iter().enumerate() {
        let half = if k == 2 { 0.5 * third } else { 0.5 };
        links.push((format!("crank {}", k + 1), [pivot[0] + half * c, pivot[1] + half * s, angle]));
        joints.push((format!("O{}", k + 1), Joint::Pin(None, k, *pivot, [-half, 0.0])));
        joints.push((format!("A{}", k + 1), Joint::Pin(Some(k), 3, [half, 0.0], *pivot)));
    }
    links.push(("coupler".to_string(), [c, s, 0.0]));
    joints.extend(motors.iter().enumerate().map(|(k, motor)| (format!("motor {}", k + 1), *motor)));
    Plan { links, joints }
}

/// A chain of links of length 1 from the origin at these angles, with motors.
pub fn chain(angles: &[f64], end: Option<[f64; 2]>, motors: &[Joint]) -> Plan {
    let mut links = Vec::new();
    let mut joints = Vec::new();
    let mut x = 0.0;
    let mut y = 0.0;
    for (k, angle) in angles.iter().enumerate() {
        let (s, c) = angle.sin_cos();
        links.push((format!("link {}", k + 1), [x + 0.5 * c, y + 0.5 * s, *angle]));
        let joint = match k {
            0 => Joint::Pin(None, 0, [0.0, 0.0], [-0.5, 0.0]),
            _ => Joint::Pin(Some(k - 1), k, [0.5, 0.0], [-0.5, 0.0]),
        };
        joints.push((format!("pin {}", k + 1), joint));
        (x, y) = (x + c, y + s);
    }
    if let Some(end) = end {
        joints.push(("end".to_string(), Joint::Pin(None, angles.len() - 1, end, [0.5, 0.0])));
    }
    joints.extend(motors.iter().enumerate().map(|(k, motor)| (format!("motor {}", k + 1), *motor)));
    Plan { links, joints }
}
