/// The constraint that [`fn@revolute`] makes.
///
/// Pin joint: point P is common to both bodies, R_i + A_i ū_i − R_j − A_j ū_j = 0.      [m]
#[allow(non_camel_case_types)]
#[derive(Clone)]
pub struct revolute {
    i: ::kin::PlanarBody,
    j: ::kin::PlanarBody,
    u_i: Vec2,
    u_j: Vec2,
}
/// Pin joint: point P is common to both bodies, R_i + A_i ū_i − R_j − A_j ū_j = 0.      [m]
#[allow(clippy::too_many_arguments)]
#[must_use]
pub fn revolute(
    i: impl ::core::convert::Into<::kin::PlanarBody>,
    j: impl ::core::convert::Into<::kin::PlanarBody>,
    u_i: Vec2,
    u_j: Vec2,
) -> revolute {
    revolute {
        i: ::core::convert::Into::into(i),
        j: ::core::convert::Into::into(j),
        u_i,
        u_j,
    }
}
#[allow(unused, clippy::all, clippy::pedantic, clippy::nursery)]
const _: () = {
    use ::kin::rt::{LiftAny as _, LiftNumbers as _, LowerAny as _, LowerReal as _};
    use ::kin::rt::{ReceiveAny as _, ReceiveNumbers as _, ReceiveReference as _};
    /// The function as it was written.
    const __WRITTEN: fn(
        ::kin::rt::PlanarState,
        ::kin::rt::PlanarState,
        Vec2,
        Vec2,
    ) -> Vec2 = |i, j, u_i, u_j| { i.point(u_i) - j.point(u_j) };
    const __SOUND: bool = {
        let _ = __WRITTEN;
        true
    };
    type __Dual<D> = ::kin::rt::If<__SOUND, D>;
    type __Real<D> = ::kin::rt::Real<__Dual<D>>;
    impl ::kin::Constraint for revolute {
        fn kind(&self) -> &str {
            "revolute"
        }
        fn route(&self) -> ::kin::Route {
            ::kin::Route::Symbolic
        }
        fn arguments(&self) -> ::std::vec::Vec<::kin::rt::Argument> {
            ::kin::rt::arguments(
                &[
                    ::kin::rt::Argument {
                        name: "i",
                        target: ::kin::rt::Target::Planar(self.i),
                    },
                    ::kin::rt::Argument {
                        name: "j",
                        target: ::kin::rt::Target::Planar(self.j),
                    },
                ],
            )
        }
        fn rows(&self) -> &[&str] {
            &["x", "y"]
        }
        fn pattern(&self) -> &[(usize, usize)] {
            &[(0, 0), (0, 2), (0, 3), (0, 5), (1, 1), (1, 2), (1, 4), (1, 5)]
        }
        fn describe(&self, to: &mut ::kin::rt::Describer) {
            use ::kin::rt::{ToldBySerde as _, Untold as _};
            to.put("u_i", &self.u_i);
            to.put("u_j", &self.u_j);
        }
        fn constants(&self) -> &[::core::option::Option<f64>] {
            &[
                ::core::option::Option::Some(1.0),
                ::core::option::Option::None,
                ::core::option::Option::Some(-1.0),
                ::core::option::Option::None,
                ::core::option::Option::Some(1.0),
                ::core::option::Option::None,
                ::core::option::Option::Some(-1.0),
                ::core::option::Option::None,
            ]
        }
        fn depends(&self) -> ::kin::Dependence {
            ::kin::Dependence {
                c_on_t: false,
                c_q_on_t: false,
                c_t: false,
                q_d: true,
                curved: true,
            }
        }
        /// C: 10 operations
        fn residual(&self, at: &::kin::rt::At<'_>, c: &mut [f64]) {
            let ::core::option::Option::Some(c) = c.first_chunk_mut::<2>() else {
                return
            };
            let fma = ::kin::rt::fma;
            let ::core::option::Option::Some(state0) = at.state::<5>(0) else { return };
            let ::core::option::Option::Some(state1) = at.state::<5>(1) else { return };
            let in_order = ::kin::rt::in_order;
            let j_sin = state1[3];
            let j_cos = state1[4];
            let i_sin = state0[3];
            let i_cos = state0[4];
            let i_x = state0[0];
            let j_x = state1[0];
            c[0] = fma(
                self.u_j.y,
                j_sin,
                fma(
                    -self.u_j.x,
                    j_cos,
                    fma(-self.u_i.y, i_sin, fma(self.u_i.x, i_cos, i_x)),
                ),
            ) - j_x;
            in_order();
            let i_y = state0[1];
            let j_y = state1[1];
            c[1] = fma(
                -self.u_j.y,
                j_cos,
                fma(
                    -self.u_j.x,
                    j_sin,
                    fma(self.u_i.y, i_cos, fma(self.u_i.x, i_sin, i_y)),
                ),
            ) - j_y;
            in_order();
        }
        /// C_q, and C on the way
        fn jacobian(&self, at: &::kin::rt::At<'_>, c_q: &mut [f64]) {
            self.linearize(at, &mut [0.0; 2], c_q);
        }
        /// C and C_q: 14 operations
        fn linearize(&self, at: &::kin::rt::At<'_>, c: &mut [f64], c_q: &mut [f64]) {
            let ::core::option::Option::Some(c) = c.first_chunk_mut::<2>() else {
                return
            };
            let ::core::option::Option::Some(c_q) = c_q.first_chunk_mut::<8>() else {
                return
            };
            let fma = ::kin::rt::fma;
            let ::core::option::Option::Some(state0) = at.state::<5>(0) else { return };
            let ::core::option::Option::Some(state1) = at.state::<5>(1) else { return };
            let in_order = ::kin::rt::in_order;
            c_q[0] = 1.0;
            c_q[2] = -1.0;
            c_q[4] = 1.0;
            c_q[6] = -1.0;
            let j_cos = state1[4];
            let j_sin = state1[3];
            let t0 = fma(self.u_j.y, j_cos, self.u_j.x * j_sin);
            c_q[3] = t0;
            in_order();
            let i_cos = state0[4];
            let i_sin = state0[3];
            let t1 = fma(-self.u_i.y, i_cos, -(self.u_i.x * i_sin));
            let i_y = state0[1];
            let j_y = state1[1];
            c[1] = ((i_y - t1) - j_y) - t0;
            in_order();
            c_q[1] = t1;
            let t2 = fma(-self.u_i.y, i_sin, self.u_i.x * i_cos);
            c_q[5] = t2;
            in_order();
            let t3 = fma(-self.u_j.x, j_cos, self.u_j.y * j_sin);
            let i_x = state0[0];
            let j_x = state1[0];
            c[0] = ((i_x + t2) - j_x) + t3;
            in_order();
            c_q[7] = t3;
        }
        fn velocity_rhs(&self, _at: &::kin::rt::At<'_>, rhs: &mut [f64]) {
            ::kin::rt::no_velocity(rhs, 2);
        }
        /// Q_d for t_dot = 1: 14 operations
        fn acceleration_rhs(
            &self,
            at: &::kin::rt::At<'_>,
            qd: &::kin::rt::Rates<'_>,
            t_dot: f64,
            q_d: &mut [f64],
        ) {
            let ::core::option::Option::Some(q_d) = q_d.first_chunk_mut::<2>() else {
                return
            };
            let fma = ::kin::rt::fma;
            let ::core::option::Option::Some(state0) = at.state::<5>(0) else { return };
            let ::core::option::Option::Some(state1) = at.state::<5>(1) else { return };
            let ::core::option::Option::Some(rate0) = qd.of::<3>(0) else { return };
            let ::core::option::Option::Some(rate1) = qd.of::<3>(1) else { return };
            let in_order = ::kin::rt::in_order;
            let i_theta_d = rate0[2];
            let t0 = i_theta_d * i_theta_d;
            let j_theta_d = rate1[2];
            let t1 = j_theta_d * j_theta_d;
            let j_cos = state1[4];
            let j_sin = state1[3];
            let i_cos = state0[4];
            let i_sin = state0[3];
            q_d[1] = fma(
                -fma(self.u_j.y, j_cos, self.u_j.x * j_sin),
                t1,
                fma(self.u_i.y, i_cos, self.u_i.x * i_sin) * t0,
            );
            in_order();
            q_d[0] = fma(
                -fma(-self.u_j.y, j_sin, self.u_j.x * j_cos),
                t1,
                fma(-self.u_i.y, i_sin, self.u_i.x * i_cos) * t0,
            );
            in_order();
        }
        #[cold]
        fn graph(
            &self,
            with: &mut dyn FnMut(
                &::kin::rt::graph::Graph,
                &[f64],
                ::kin::rt::graph::Outside<'_>,
            ),
        ) {
            use ::kin::rt::graph::*;
            const GRAPH: &Graph = &Graph {
                file: ::core::file!(),
                expressions: &[
                    ("i.point(u_i)", 1, 1),
                    ("j.point(u_j)", 1, 1),
                    ("i.point(u_i) - j.point(u_j)", 1, 1),
                ],
                steps: &[
                    (65535, Parameter(0)),
                    (65535, Parameter(1)),
                    (65535, Parameter(2)),
                    (65535, Parameter(3)),
                    (0, Column(0)),
                    (0, Column(1)),
                    (0, Column(2)),
                    (0, Call(Sin, 6)),
                    (0, Column(2)),
                    (0, Call(Cos, 8)),
                    (0, Call2(Product, 0, 9)),
                    (0, Call2(Product, 1, 7)),
                    (0, Call2(Difference, 10, 11)),
                    (0, Call2(Product, 0, 7)),
                    (0, Call2(Product, 1, 9)),
                    (0, Call2(Sum, 13, 14)),
                    (0, Call2(Sum, 4, 12)),
                    (0, Call2(Sum, 5, 15)),
                    (1, Column(3)),
                    (1, Column(4)),
                    (1, Column(5)),
                    (1, Call(Sin, 20)),
                    (1, Column(5)),
                    (1, Call(Cos, 22)),
                    (1, Call2(Product, 2, 23)),
                    (1, Call2(Product, 3, 21)),
                    (1, Call2(Difference, 24, 25)),
                    (1, Call2(Product, 2, 21)),
                    (1, Call2(Product, 3, 23)),
                    (1, Call2(Sum, 27, 28)),
                    (1, Call2(Sum, 18, 26)),
                    (1, Call2(Sum, 19, 29)),
                    (2, Call2(Difference, 16, 30)),
                    (2, Call2(Difference, 17, 31)),
                ],
                rows: &[32, 33],
                parameters: &["u_i.x", "u_i.y", "u_j.x", "u_j.y"],
            };
            with(
                GRAPH,
                &[self.u_i.x, self.u_i.y, self.u_j.x, self.u_j.y],
                &nothing_outside,
            );
        }
        fn attachments(&self) -> ::std::vec::Vec<::kin::rt::Attachment> {
            let mut u = [[0.0_f64; 3]; 2];
            u[0][0] = self.u_i.x;
            u[0][1] = self.u_i.y;
            u[1][0] = self.u_j.x;
            u[1][1] = self.u_j.y;
            ::kin::rt::attachments(&[(0, true), (1, true)], &u)
        }
        fn in_lanes(&self) -> ::core::option::Option<&dyn ::kin::rt::InLanes> {
            ::core::option::Option::Some(self)
        }
        fn description(&self) -> &str {
            "Pin joint: point P is common to both bodies, R_i + A_i ū_i − R_j − A_j ū_j = 0.      [m]"
        }
        fn parameters(&self, visit: &mut dyn FnMut(&str, f64)) {
            ::kin::rt::Numbers::visit(&self.u_i, "u_i", visit);
            ::kin::rt::Numbers::visit(&self.u_j, "u_j", visit);
        }
        fn set_parameter(&mut self, name: &str, value: f64) -> bool {
            ::kin::rt::Numbers::set(&mut self.u_i, "u_i", name, value)
                || ::kin::rt::Numbers::set(&mut self.u_j, "u_j", name, value)
        }
        fn set_parameter_at(&mut self, mut index: usize, value: f64) -> bool {
            ::kin::rt::Numbers::set_at(&mut self.u_i, &mut index, value)
                || ::kin::rt::Numbers::set_at(&mut self.u_j, &mut index, value)
        }
        fn has_branches(&self) -> bool {
            false
        }
    }
    impl ::kin::rt::InLanes for revolute {
        fn kernels(&self) -> ::kin::rt::LaneKernels {
            ::kin::rt::LaneKernels::of::<Self>()
        }
        fn n_known(&self) -> [usize; 2] {
            [4, 0]
        }
        fn of_parameters(&self, known: &mut [f64]) {
            let ::core::option::Option::Some(known) = known.first_chunk_mut::<4>() else {
                return
            };
            let (at, t_dot) = (&::kin::rt::At::new(0.0, &[], &[]), 1.0);
            known[0] = self.u_i.x;
            known[1] = self.u_i.y;
            known[2] = self.u_j.x;
            known[3] = self.u_j.y;
        }
        fn of_time(&self, t: f64, known: &mut [f64]) {
            let ::core::option::Option::Some(known) = known.first_chunk_mut::<0>() else {
                return
            };
            let (at, t_dot) = (&::kin::rt::At::new(t, &[], &[]), 1.0);
        }
        fn evaluate(&self, number: usize, x: &[f64], y: &mut [f64]) {
            match number {
                _ => {}
            }
        }
    }
    impl ::kin::rt::LaneKernel for revolute {
        #[inline(always)]
        fn linearize<__S: ::kin::rt::Level>(
            at: &::kin::rt::LaneAt<'_, __S>,
            c: &mut [::kin::rt::Wide<__S>],
            c_q: &mut [::kin::rt::Wide<__S>],
        ) {
            let ::core::option::Option::Some(c) = c.first_chunk_mut::<2>() else {
                return
            };
            let ::core::option::Option::Some(c_q) = c_q.first_chunk_mut::<8>() else {
                return
            };
            let ::core::option::Option::Some(&[known0, known1, known2, known3]) = at
                .known::<4>() else { return };
            let ::core::option::Option::Some(state0) = at.state::<5>(0) else { return };
            let ::core::option::Option::Some(state1) = at.state::<5>(1) else { return };
            let j_sin = state1[3];
            let j_cos = state1[4];
            let t0 = (known2 * j_sin) + (known3 * j_cos);
            c_q[3] = t0;
            let i_sin = state0[3];
            let i_cos = state0[4];
            let t1 = (known0 * i_sin) + (known1 * i_cos);
            let i_y = state0[1];
            let j_y = state1[1];
            c[1] = (i_y + t1) - (j_y + t0);
            c_q[1] = -t1;
            let t2 = (known0 * i_cos) - (known1 * i_sin);
            c_q[5] = t2;
            let t3 = (known2 * j_cos) - (known3 * j_sin);
            let i_x = state0[0];
            let j_x = state1[0];
            c[0] = (i_x + t2) - (j_x + t3);
            c_q[7] = -t3;
        }
        #[inline(always)]
        fn velocity_rhs<__S: ::kin::rt::Level>(
            at: &::kin::rt::LaneAt<'_, __S>,
            rhs: &mut [::kin::rt::Wide<__S>],
        ) {
            let ::core::option::Option::Some(rhs) = rhs.first_chunk_mut::<0>() else {
                return
            };
            let ::core::option::Option::Some(&[known0, known1, known2, known3]) = at
                .known::<4>() else { return };
        }
        #[inline(always)]
        fn acceleration_rhs<__S: ::kin::rt::Level>(
            at: &::kin::rt::LaneAt<'_, __S>,
            qd: &::kin::rt::LaneRates<'_, __S>,
            q_d: &mut [::kin::rt::Wide<__S>],
        ) {
            let ::core::option::Option::Some(q_d) = q_d.first_chunk_mut::<2>() else {
                return
            };
            let ::core::option::Option::Some(&[known0, known1, known2, known3]) = at
                .known::<4>() else { return };
            let ::core::option::Option::Some(state0) = at.state::<5>(0) else { return };
            let ::core::option::Option::Some(state1) = at.state::<5>(1) else { return };
            let ::core::option::Option::Some(rate0) = qd.of::<3>(0) else { return };
            let ::core::option::Option::Some(rate1) = qd.of::<3>(1) else { return };
            let j_theta_d = rate1[2];
            let t0 = j_theta_d * j_theta_d;
            let i_theta_d = rate0[2];
            let t1 = i_theta_d * i_theta_d;
            let j_cos = state1[4];
            let j_sin = state1[3];
            let i_cos = state0[4];
            let i_sin = state0[3];
            q_d[0] = -((((known2 * j_cos) - (known3 * j_sin)) * t0)
                - (((known0 * i_cos) - (known1 * i_sin)) * t1));
            q_d[1] = -((((known2 * j_sin) + (known3 * j_cos)) * t0)
                - (((known0 * i_sin) + (known1 * i_cos)) * t1));
        }
    }
    impl ::kin::rt::Described for revolute {
        const KIND: &'static str = "revolute";
        const ARGUMENTS: &'static [::kin::rt::ArgumentKind] = <Self as ::kin::rt::Equation<
            6,
            2,
        >>::ARGUMENTS;
        fn read(from: &mut ::kin::rt::Reader<'_>) -> ::core::option::Option<Self> {
            use ::kin::rt::{SoughtBySerde as _, Unsought as _};
            ::core::option::Option::Some(revolute {
                i: from.planar(),
                j: from.planar(),
                u_i: from.get("u_i"),
                u_j: from.get("u_j"),
            })
        }
    }
    impl ::kin::rt::Equation<6, 2> for revolute {
        const ARGUMENTS: &'static [::kin::rt::ArgumentKind] = &[
            ::kin::rt::ArgumentKind::Planar,
            ::kin::rt::ArgumentKind::Planar,
        ];
        fn evaluate<__D: ::kin::rt::Dual>(
            &self,
            q: &[::kin::rt::Real<__D>; 6],
            t: ::kin::rt::Real<__D>,
        ) -> [::kin::rt::Real<__D>; 2] {
            let i = ::kin::rt::PlanarState::<__Real<__D>>::new([q[0], q[1], q[2]]);
            let j = ::kin::rt::PlanarState::<__Real<__D>>::new([q[3], q[4], q[5]]);
            let u_i: ::kin::rt::Vec2<__Real<__D>> = ::kin::rt::Lift::lift(self.u_i);
            let u_j: ::kin::rt::Vec2<__Real<__D>> = ::kin::rt::Lift::lift(self.u_j);
            let value = (move || -> ::kin::rt::Vec2<__Real<__D>> {
                i.point(u_i) - j.point(u_j)
            })();
            ::kin::rt::rows(value)
        }
        #[inline]
        fn plain(&self, q: &[f64; 6], t: f64) -> [f64; 2] {
            ::kin::rt::rows(
                __WRITTEN(
                    ::kin::rt::PlanarState::new([q[0], q[1], q[2]]),
                    ::kin::rt::PlanarState::new([q[3], q[4], q[5]]),
                    self.u_i,
                    self.u_j,
                ),
            )
        }
    }
};
