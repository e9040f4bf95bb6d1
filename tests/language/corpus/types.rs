//! Types of the user's own: structs, enums, traits, generics, operators, newtypes.

use std::ops::{Add, Index, IndexMut, Mul, Sub};

use kin::prelude::*;

use crate::twice;

twice! { Symbolic units_as_newtypes(coord coord): fn f(a: Coord, b: Coord) -> f64 {
    #[derive(Clone, Copy, PartialEq, PartialOrd)]
    struct Metres(f64);
    impl Add for Metres {
        type Output = Metres;
        fn add(self, o: Metres) -> Metres {
            Metres(self.0 + o.0)
        }
    }
    impl Sub for Metres {
        type Output = Metres;
        fn sub(self, o: Metres) -> Metres {
            Metres(self.0 - o.0)
        }
    }
    impl From<f64> for Metres {
        fn from(x: f64) -> Self {
            Metres(x)
        }
    }
    let x = Metres::from(a);
    let y = Metres(b);
    let gap = if x < y { y - x } else { x - y };
    (gap + Metres(0.1)).0
} }

twice! { Symbolic matrix_with_indices(coord coord): fn f(a: Coord, b: Coord) -> f64 {
    struct Grid {
        cells: [f64; 4],
    }
    impl Index<(usize, usize)> for Grid {
        type Output = f64;
        fn index(&self, (i, j): (usize, usize)) -> &f64 {
            &self.cells[2 * i + j]
        }
    }
    impl IndexMut<(usize, usize)> for Grid {
        fn index_mut(&mut self, (i, j): (usize, usize)) -> &mut f64 {
            &mut self.cells[2 * i + j]
        }
    }
    let mut m = Grid { cells: [1.0, a, b, 2.0] };
    m[(0, 0)] += a * b;
    m[(0, 0)] * m[(1, 1)] - m[(0, 1)] * m[(1, 0)]
} }

twice! { Symbolic builder_of_a_linkage(coord coord coord): fn f(a: Coord, b: Coord, c: Coord) -> (f64, f64) {
    #[derive(Default, Clone)]
    struct Linkage {
        x: f64,
        y: f64,
    }
    impl Linkage {
        fn link(mut self, length: f64, angle: f64) -> Self {
            self.x += length * angle.cos();
            self.y += length * angle.sin();
            self
        }
        fn closed(&self) -> (f64, f64) {
            (self.x, self.y)
        }
    }
    Linkage::default().link(1.0, a).link(2.0, b).link(-1.5, c).link(-1.2, 0.0).closed()
} }

twice! { Symbolic enum_of_joints(coord coord): fn f(a: Coord, b: Coord) -> Vec2 {
    enum Joint {
        Revolute { angle: f64, arm: f64 },
        Slider(f64),
        Fixed,
    }
    use Joint::*;
    let chain = [Revolute { angle: a, arm: 0.8 }, Slider(b), Fixed];
    let mut at = vec2(0.0, 0.0);
    let mut heading = 0.0;
    for joint in &chain {
        match joint {
            Revolute { angle, arm } => {
                heading += angle;
                at += vec2(arm * heading.cos(), arm * heading.sin());
            }
            Slider(s) => at = at + vec2(heading.cos(), heading.sin()) * *s,
            Fixed => {}
        }
    }
    at - vec2(1.0, 0.5)
} }

twice! { Symbolic trait_with_a_default(coord coord): fn f(a: Coord, b: Coord) -> f64 {
    trait Profile {
        fn lift(&self, phi: f64) -> f64;
        fn slope(&self, phi: f64) -> f64 {
            (self.lift(phi + 0.01) - self.lift(phi - 0.01)) / 0.02
        }
    }
    struct Harmonic(f64);
    impl Profile for Harmonic {
        fn lift(&self, phi: f64) -> f64 {
            0.5 * self.0 * (1.0 - phi.cos())
        }
    }
    struct Cycloidal {
        height: f64,
    }
    impl Profile for Cycloidal {
        fn lift(&self, phi: f64) -> f64 {
            self.height * (phi - phi.sin())
        }
        fn slope(&self, phi: f64) -> f64 {
            self.height * (1.0 - phi.cos())
        }
    }
    fn both<P: Profile>(p: &P, phi: f64) -> f64 {
        p.lift(phi) + p.slope(phi)
    }
    both(&Harmonic(0.3), a) - both(&Cycloidal { height: 0.1 }, b)
} }

twice! { Symbolic generic_pair_inside(coord coord): fn f(a: Coord, b: Coord) -> f64 {
    #[derive(Clone, Copy)]
    struct Pair<T> {
        first: T,
        second: T,
    }
    impl<T: Copy + Mul<Output = T> + Add<Output = T>> Pair<T> {
        fn dot(&self, other: &Pair<T>) -> T {
            self.first * other.first + self.second * other.second
        }
        fn swapped(self) -> Self {
            Pair { first: self.second, second: self.first }
        }
    }
    let p = Pair { first: a, second: b };
    let counts = Pair { first: 2, second: 3 };
    p.dot(&p.swapped()) - counts.first as f64 * p.dot(&Pair { first: 0.5, second: counts.second as f64 })
} }

/// A jet of first order, for another differentiation than Kin's own.
#[derive(Clone, Copy)]
pub struct Jet<T> {
    pub value: T,
    pub slope: T,
}

impl<T: Copy + Add<Output = T> + Mul<Output = T>> Mul for Jet<T> {
    type Output = Jet<T>;
    fn mul(self, o: Jet<T>) -> Jet<T> {
        Jet { value: self.value * o.value, slope: self.slope * o.value + self.value * o.slope }
    }
}

impl<T: Add<Output = T>> Add for Jet<T> {
    type Output = Jet<T>;
    fn add(self, o: Jet<T>) -> Jet<T> {
        Jet { value: self.value + o.value, slope: self.slope + o.slope }
    }
}

twice! { Symbolic stationary_point_by_jets(coord coord): fn f(x: Coord, y: Coord) -> (f64, f64) {
    let u = Jet { value: x, slope: 1.0 };
    let k = Jet { value: y, slope: 0.0 };
    let energy = u * u * u + k * u * u + k;
    (energy.slope, energy.value - 0.3)
} }

#[derive(Clone, Debug)]
pub enum Motor {
    Off,
    Constant(f64),
    Ramp { from: f64, rate: f64 },
}

macro_rules! motors {
    ($($name:ident $motor:expr;)*) => {$(
        twice! { Symbolic $name(coord time ($motor)): fn f(a: Coord, t: Time, motor: Motor) -> f64 {
            let angle = match &motor {
                Motor::Off => 0.0,
                Motor::Constant(speed) => speed * t,
                Motor::Ramp { from, rate } => from + 0.5 * rate * t * t,
            };
            if matches!(motor, Motor::Off) { a.sin() } else { a - angle }
        } }
    )*};
}
motors! {
    motor_that_is_off Motor::Off;
    motor_at_a_constant_speed Motor::Constant(2.0);
    motor_on_a_ramp Motor::Ramp { from: 0.1, rate: 0.5 };
}

#[derive(Clone)]
pub struct Crane {
    pub boom: (f64, f64),
    pub pulleys: Vec<f64>,
    pub hook: Option<f64>,
    pub base: Vec2,
}

impl Crane {
    pub fn reach(&self) -> f64 {
        self.boom.0 + self.boom.1
    }

    pub fn pulley(&self, k: usize) -> f64 {
        self.pulleys[k % self.pulleys.len()]
    }
}

pub fn crane() -> Crane {
    Crane { boom: (2.0, 1.5), pulleys: vec![0.1, 0.2], hook: Some(0.3), base: vec2(0.5, 0.0) }
}

twice! { Symbolic parameter_with_methods(coord coord (crane())): fn f(luff: Coord, rope: Coord, crane: Crane) -> (Vec2, f64) {
    let tip = vec2(crane.reach() * luff.cos(), crane.reach() * luff.sin());
    let hook = crane.hook.unwrap_or(0.0);
    let base: Vec2 = crane.base;
    (tip - base, rope - crane.pulley(3) * luff - hook + crane.boom.1)
} }

twice! { Symbolic associated_constants(coord): fn f(a: Coord) -> f64 {
    trait Thread {
        const PITCH: f64;
        const STARTS: u32 = 1;
        fn lead() -> f64 {
            Self::PITCH * Self::STARTS as f64
        }
    }
    struct M8;
    struct Trapezoidal;
    impl Thread for M8 {
        const PITCH: f64 = 1.25;
    }
    impl Thread for Trapezoidal {
        const PITCH: f64 = 4.0;
        const STARTS: u32 = 2;
    }
    a * M8::lead() - Trapezoidal::lead() * a.sin() + <M8 as Thread>::PITCH
} }

twice! { Symbolic phantom_states(coord): fn f(a: Coord) -> f64 {
    use std::marker::PhantomData;
    struct Open;
    struct Closed;
    struct Gripper<S> {
        width: f64,
        state: PhantomData<S>,
    }
    impl Gripper<Open> {
        fn close(self, by: f64) -> Gripper<Closed> {
            Gripper { width: self.width - by, state: PhantomData }
        }
    }
    impl Gripper<Closed> {
        fn force(&self) -> f64 {
            2.0 * self.width.powi(2)
        }
    }
    Gripper::<Open> { width: 1.0, state: PhantomData }.close(a).force() - 0.5
} }

twice! { Symbolic polynomial_by_a_const_generic(coord coord): fn f(x: Coord, y: Coord) -> f64 {
    struct Poly<const N: usize>([f64; N]);
    impl<const N: usize> Poly<N> {
        fn at(&self, x: f64) -> f64 {
            self.0.iter().rev().fold(0.0, |sum, c| sum * x + c)
        }
        fn slope(&self, x: f64) -> f64 {
            (1..N).map(|k| k as f64 * self.0[k] * x.powi(k as i32 - 1)).sum()
        }
    }
    let p = Poly([0.5, -1.0, 0.25, 0.125]);
    p.at(x) + p.slope(x) * (y - x)
} }

twice! { Symbolic display_of_nothing(coord): fn f(a: Coord) -> f64 {
    #[derive(Debug, Clone, Copy, PartialEq, Eq, Hash, PartialOrd, Ord)]
    enum Gear {
        First = 1,
        Second,
        Fifth = 5,
    }
    let gear = if a > 0.5 { Gear::Fifth } else if a > 0.0 { Gear::Second } else { Gear::First };
    a / gear as i32 as f64 - 0.1
} }
