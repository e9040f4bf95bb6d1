/// The constraint that [`fn@revolute`] makes.
///
/// Pin joint: point P is common to both bodies, R_i + A_i ū_i − R_j − A_j ū_j = 0.      [m]
#[allow(non_camel_case_types, non_snake_case)]
#[derive(Clone)]
pub struct revolute {
    i: ::kin::PlanarBody,
    j: ::kin::PlanarBody,
    u_i: Vec2,
    u_j: Vec2,
    __bindings: ::kin::emitted::Bindings,
}
/// Pin joint: point P is common to both bodies, R_i + A_i ū_i − R_j − A_j ū_j = 0.      [m]
#[allow(clippy::too_many_arguments)]
#[must_use]
pub fn revolute(
    i: impl ::kin::emitted::IntoPlanarBody,
    j: impl ::kin::emitted::IntoPlanarBody,
    u_i: impl ::kin::emitted::Components<2, Scalar: ::kin::emitted::IntoNumber>,
    u_j: impl ::kin::emitted::Components<2, Scalar: ::kin::emitted::IntoNumber>,
) -> revolute {
    let mut noted = ::kin::emitted::Bindings::NONE;
    let bindings = &mut noted;
    revolute {
        i: ::kin::emitted::IntoPlanarBody::into_planar_body(i),
        j: ::kin::emitted::IntoPlanarBody::into_planar_body(j),
        u_i: ::kin::emitted::vector(u_i, "u_i", bindings),
        u_j: ::kin::emitted::vector(u_j, "u_j", bindings),
        __bindings: noted,
    }
}
const _: () = {
    #[allow(unused_imports)]
    use ::kin::emitted::{LiftAny as _, LiftNumbers as _, LowerAny as _, LowerReal as _};
    #[allow(unused_imports)]
    use ::kin::emitted::{
        ReceiveAny as _, ReceiveNumbers as _, ReceiveReference as _, TakesAsIs as _,
        TakesConverted as _,
    };
    /// The function as it was written.
    #[allow(clippy::all, clippy::pedantic, clippy::nursery)]
    const __WRITTEN: fn(
        ::kin::emitted::PlanarState,
        ::kin::emitted::PlanarState,
        Vec2,
        Vec2,
    ) -> Vec2 = |i, j, u_i, u_j| { i.point(u_i) - j.point(u_j) };
    #[allow(unused, non_snake_case, clippy::all, clippy::pedantic, clippy::nursery)]
    const __SOUND: bool = {
        let _ = __WRITTEN;
        true
    };
    #[allow(dead_code)]
    type __Dual<D> = ::kin::emitted::If<__SOUND, D>;
    #[allow(dead_code)]
    type __Real<D> = ::kin::emitted::Real<__Dual<D>>;
    #[allow(unused, non_snake_case, clippy::all, clippy::pedantic, clippy::nursery)]
    impl ::kin::Constraint for revolute {
        fn facts(&self) -> ::kin::emitted::Facts<'_> {
            const FACTS: ::kin::emitted::Facts<'static> = ::kin::emitted::Facts {
                description: "Pin joint: point P is common to both bodies, R_i + A_i ū_i − R_j − A_j ū_j = 0.      [m]",
                is_driver: false,
                rows: &["x", "y"],
                pattern: &[
                    ::kin::emitted::Entry::new(0, 0),
                    ::kin::emitted::Entry::new(0, 2),
                    ::kin::emitted::Entry::new(0, 3),
                    ::kin::emitted::Entry::new(0, 5),
                    ::kin::emitted::Entry::new(1, 1),
                    ::kin::emitted::Entry::new(1, 2),
                    ::kin::emitted::Entry::new(1, 4),
                    ::kin::emitted::Entry::new(1, 5),
                ],
                reason: ::kin::extend::RouteReason::Read,
                constants: &[
                    ::core::option::Option::Some(1.0),
                    ::core::option::Option::None,
                    ::core::option::Option::Some(-1.0),
                    ::core::option::Option::None,
                    ::core::option::Option::Some(1.0),
                    ::core::option::Option::None,
                    ::core::option::Option::Some(-1.0),
                    ::core::option::Option::None,
                ],
                dependence: ::kin::emitted::Dependence {
                    c_on_t: false,
                    c_q_on_t: false,
                    c_t: false,
                    q_d: true,
                    curved: true,
                },
                has_branches: false,
                ..::kin::emitted::Facts::of("revolute")
            };
            FACTS
        }
        fn arguments(&self) -> ::std::vec::Vec<::kin::emitted::Argument> {
            ::kin::emitted::arguments(
                &[
                    ::kin::emitted::Argument {
                        name: "i",
                        target: ::kin::emitted::Target::Planar(self.i),
                    },
                    ::kin::emitted::Argument {
                        name: "j",
                        target: ::kin::emitted::Target::Planar(self.j),
                    },
                ],
            )
        }
        fn residual(&self, at: &::kin::emitted::At<'_>, c: &mut [f64]) {
            self.linearize(at, c, &mut [0.0; 8]);
        }
        fn jacobian(&self, at: &::kin::emitted::At<'_>, c_q: &mut [f64]) {
            self.linearize(at, &mut [0.0; 2], c_q);
        }
        /// C and C_q: 14 operations
        fn linearize(
            &self,
            at: &::kin::emitted::At<'_>,
            c: &mut [f64],
            c_q: &mut [f64],
        ) {
            let ::core::option::Option::Some([c_0, c_1]) = c.first_chunk_mut() else {
                return
            };
            let ::core::option::Option::Some(
                [c_q_0,
                c_q_1,
                c_q_2,
                c_q_3,
                c_q_4,
                c_q_5,
                c_q_6,
                c_q_7,
                ],
            ) = c_q.first_chunk_mut() else { return };
            let fma = ::kin::emitted::fma;
            let ::core::option::Option::Some([i_x, i_y, _, i_sin, i_cos]) = at.state(0)
            else { return };
            let ::core::option::Option::Some([j_x, j_y, _, j_sin, j_cos]) = at.state(1)
            else { return };
            let put = ::kin::emitted::put;
            *c_q_0 = 1.0;
            *c_q_2 = -1.0;
            *c_q_4 = 1.0;
            *c_q_6 = -1.0;
            let j_cos = *j_cos;
            let j_sin = *j_sin;
            let t0 = fma(self.u_j.y, j_cos, self.u_j.x * j_sin);
            put(c_q_3, t0);
            let i_cos = *i_cos;
            let i_sin = *i_sin;
            let t1 = fma(-self.u_i.y, i_cos, -(self.u_i.x * i_sin));
            let i_y = *i_y;
            let j_y = *j_y;
            put(c_1, ((i_y - t1) - j_y) - t0);
            *c_q_1 = t1;
            let t2 = fma(-self.u_i.y, i_sin, self.u_i.x * i_cos);
            put(c_q_5, t2);
            let t3 = fma(-self.u_j.x, j_cos, self.u_j.y * j_sin);
            let i_x = *i_x;
            let j_x = *j_x;
            put(c_0, ((i_x + t2) - j_x) + t3);
            *c_q_7 = t3;
        }
        fn velocity_rhs(&self, _at: &::kin::emitted::At<'_>, rhs: &mut [f64]) {
            ::kin::emitted::no_velocity(rhs, 2);
        }
        /// Q_d for t_dot = 1: 14 operations
        fn acceleration_rhs(
            &self,
            at: &::kin::emitted::At<'_>,
            qd: &::kin::emitted::Rates<'_>,
            t_dot: f64,
            q_d: &mut [f64],
        ) {
            let ::core::option::Option::Some([q_d_0, q_d_1]) = q_d.first_chunk_mut()
            else { return };
            let fma = ::kin::emitted::fma;
            let ::core::option::Option::Some([_, _, _, i_sin, i_cos]) = at.state(0) else {
                return
            };
            let ::core::option::Option::Some([_, _, _, j_sin, j_cos]) = at.state(1) else {
                return
            };
            let ::core::option::Option::Some([_, _, i_theta_d]) = qd.of(0) else {
                return
            };
            let ::core::option::Option::Some([_, _, j_theta_d]) = qd.of(1) else {
                return
            };
            let put = ::kin::emitted::put;
            let i_theta_d = *i_theta_d;
            let t0 = i_theta_d * i_theta_d;
            let j_theta_d = *j_theta_d;
            let t1 = j_theta_d * j_theta_d;
            let j_cos = *j_cos;
            let j_sin = *j_sin;
            let i_cos = *i_cos;
            let i_sin = *i_sin;
            put(
                q_d_1,
                fma(
                    -fma(self.u_j.y, j_cos, self.u_j.x * j_sin),
                    t1,
                    fma(self.u_i.y, i_cos, self.u_i.x * i_sin) * t0,
                ),
            );
            put(
                q_d_0,
                fma(
                    -fma(-self.u_j.y, j_sin, self.u_j.x * j_cos),
                    t1,
                    fma(-self.u_i.y, i_sin, self.u_i.x * i_cos) * t0,
                ),
            );
        }
        fn parts(&self) -> ::kin::emitted::Parts<'_> {
            ::kin::emitted::Parts {
                parameters: ::core::option::Option::Some(self),
                written: ::core::option::Option::Some(self),
            }
        }
        fn parameters_mut(
            &mut self,
        ) -> ::core::option::Option<&mut dyn ::kin::emitted::Parameters> {
            ::core::option::Option::Some(self)
        }
    }
    #[allow(unused, non_snake_case, clippy::all, clippy::pedantic, clippy::nursery)]
    impl ::kin::emitted::Parameters for revolute {
        fn parameters(&self, visit: &mut dyn FnMut(&str, f64)) {
            ::kin::emitted::visit(&[("u_i", &self.u_i), ("u_j", &self.u_j)], visit);
        }
        fn set_parameter(&mut self, name: &str, value: f64) -> bool {
            ::kin::emitted::set(
                &mut [("u_i", &mut self.u_i), ("u_j", &mut self.u_j)],
                name,
                value,
            )
        }
        fn set_parameter_at(&mut self, index: usize, value: f64) -> bool {
            ::kin::emitted::set_at(&mut [&mut self.u_i, &mut self.u_j], index, value)
        }
        fn take_bindings(&mut self) -> ::kin::emitted::Bindings {
            ::core::mem::take(&mut self.__bindings)
        }
        fn describe(&self, to: &mut ::kin::emitted::Describer) {
            use ::kin::emitted::{
                OutgoingBySerde as _, OutgoingConstant as _, OutgoingRefused as _,
                RefusedConstant as _,
            };
            to.put("u_i", &self.u_i);
            to.put("u_j", &self.u_j);
            to.put_text(
                ::core::module_path!(),
                "/// Pin joint: point P is common to both bodies, R_i + A_i ū_i − R_j − A_j ū_j = 0.      [m]\npub fn revolute(i: Planar, j: Planar, u_i: Vec2, u_j: Vec2) -> Vec2 { i . point (u_i) - j . point (u_j) }",
            );
        }
    }
    #[allow(unused, non_snake_case, clippy::all, clippy::pedantic, clippy::nursery)]
    impl ::kin::emitted::Written for revolute {
        #[cold]
        fn table(
            &self,
        ) -> ::core::option::Option<
            (&'static ::kin::emitted::graph::Table, ::std::vec::Vec<f64>),
        > {
            static TABLE: ::kin::emitted::graph::Table = ::kin::emitted::graph::Table::new(
                ::core::file!(),
                r##"
at 1 1 i.point(u_i)
at 1 1 j.point(u_j)
at 1 1 i.point(u_i) - j.point(u_j)
parameters u_i.x u_i.y u_j.x u_j.y
rows 30 31
- Parameter 0
- Parameter 1
- Parameter 2
- Parameter 3
0 Column 0
0 Column 1
0 Column 2
0 Sin 6
0 Cos 6
0 Product 0 8
0 Product 1 7
0 Difference 9 10
0 Product 0 7
0 Product 1 8
0 Sum 12 13
0 Sum 4 11
0 Sum 5 14
1 Column 3
1 Column 4
1 Column 5
1 Sin 19
1 Cos 19
1 Product 2 21
1 Product 3 20
1 Difference 22 23
1 Product 2 20
1 Product 3 21
1 Sum 25 26
1 Sum 17 24
1 Sum 18 27
2 Difference 15 28
2 Difference 16 29"##,
            );
            TABLE.with(&[self.u_i.x, self.u_i.y, self.u_j.x, self.u_j.y])
        }
        fn attachments(&self) -> ::std::vec::Vec<::kin::emitted::Attachment> {
            ::kin::emitted::attachments(
                &[
                    ::kin::emitted::point(0, [self.u_i.x, self.u_i.y, 0.0]),
                    ::kin::emitted::point(1, [self.u_j.x, self.u_j.y, 0.0]),
                ],
            )
        }
    }
    #[allow(unused, non_snake_case, clippy::all, clippy::pedantic, clippy::nursery)]
    impl ::kin::emitted::Described for revolute {
        const KIND: &'static str = "revolute";
        const ARGUMENTS: &'static [::kin::emitted::ArgumentKind] = <Self as ::kin::emitted::Equation<
            6,
            2,
        >>::ARGUMENTS;
        fn read(from: &mut ::kin::emitted::Reader<'_>) -> ::core::option::Option<Self> {
            use ::kin::emitted::{IncomingBySerde as _, IncomingRefused as _};
            ::core::option::Option::Some(revolute {
                i: from.planar(),
                j: from.planar(),
                u_i: from.get("u_i"),
                u_j: from.get("u_j"),
                __bindings: ::kin::emitted::Bindings::NONE,
            })
        }
    }
    #[allow(unused, non_snake_case, clippy::all, clippy::pedantic, clippy::nursery)]
    impl ::kin::emitted::Equation<6, 2> for revolute {
        const ARGUMENTS: &'static [::kin::emitted::ArgumentKind] = &[
            ::kin::emitted::ArgumentKind::Planar,
            ::kin::emitted::ArgumentKind::Planar,
        ];
        fn evaluate<__D: ::kin::emitted::Dual>(
            &self,
            q: &[::kin::emitted::Real<__D>; 6],
            t: ::kin::emitted::Real<__D>,
        ) -> [::kin::emitted::Real<__D>; 2] {
            let mut q = ::kin::emitted::Columns(q);
            let i: ::kin::emitted::PlanarState<__Real<__D>> = q.planar();
            let j: ::kin::emitted::PlanarState<__Real<__D>> = q.planar();
            let u_i: ::kin::emitted::Vec2<__Real<__D>> = ::kin::emitted::Lift::lift(
                self.u_i,
            );
            let u_j: ::kin::emitted::Vec2<__Real<__D>> = ::kin::emitted::Lift::lift(
                self.u_j,
            );
            let value = (move || -> ::kin::emitted::Vec2<__Real<__D>> {
                i.point(u_i) - j.point(u_j)
            })();
            ::kin::emitted::rows(value)
        }
        #[inline]
        fn plain(&self, q: &[f64; 6], t: f64) -> [f64; 2] {
            let mut q = ::kin::emitted::Columns(q);
            ::kin::emitted::rows(__WRITTEN(q.planar(), q.planar(), self.u_i, self.u_j))
        }
    }
};
