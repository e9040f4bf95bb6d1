/// The constraint that [`fn@slider_crank`] makes.
///
/// Loop closure of the slider-crank, crank driven at ω.      [m]
#[allow(non_camel_case_types, non_snake_case)]
#[derive(Clone)]
struct slider_crank {
    theta3: ::kin::Coordinate,
    x: ::kin::Coordinate,
    l2: f64,
    l3: f64,
    h: f64,
    omega: f64,
    __bindings: ::kin::emitted::Bindings,
}
/// Loop closure of the slider-crank, crank driven at ω.      [m]
#[allow(clippy::too_many_arguments)]
#[must_use]
fn slider_crank(
    theta3: impl ::kin::emitted::IntoCoordinate,
    x: impl ::kin::emitted::IntoCoordinate,
    l2: impl ::kin::emitted::IntoParameter<f64>,
    l3: impl ::kin::emitted::IntoParameter<f64>,
    h: impl ::kin::emitted::IntoParameter<f64>,
    omega: impl ::kin::emitted::IntoParameter<f64>,
) -> slider_crank {
    let mut noted = ::kin::emitted::Bindings::NONE;
    let bindings = &mut noted;
    slider_crank {
        theta3: ::kin::emitted::IntoCoordinate::into_coordinate(theta3),
        x: ::kin::emitted::IntoCoordinate::into_coordinate(x),
        l2: ::kin::emitted::parameter(l2, "l2", bindings),
        l3: ::kin::emitted::parameter(l3, "l3", bindings),
        h: ::kin::emitted::parameter(h, "h", bindings),
        omega: ::kin::emitted::parameter(omega, "omega", bindings),
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
    const __WRITTEN: fn(f64, f64, f64, f64, f64, f64, f64) -> [f64; 2] = |
        theta3,
        x,
        t,
        l2,
        l3,
        h,
        omega|
    {
        let theta2 = omega * t;
        [
            l2 * theta2.cos() + l3 * theta3.cos() - x,
            l2 * theta2.sin() + l3 * theta3.sin() - h,
        ]
    };
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
    impl ::kin::Constraint for slider_crank {
        fn facts(&self) -> ::kin::emitted::Facts<'_> {
            const FACTS: ::kin::emitted::Facts<'static> = ::kin::emitted::Facts {
                description: "Loop closure of the slider-crank, crank driven at ω.      [m]",
                is_driver: true,
                rows: &["1", "2"],
                pattern: &[
                    ::kin::emitted::Entry::new(0, 0),
                    ::kin::emitted::Entry::new(0, 1),
                    ::kin::emitted::Entry::new(1, 0),
                ],
                reason: ::kin::extend::RouteReason::Read,
                constants: &[
                    ::core::option::Option::None,
                    ::core::option::Option::Some(-1.0),
                    ::core::option::Option::None,
                ],
                dependence: ::kin::emitted::Dependence {
                    c_on_t: true,
                    c_q_on_t: false,
                    c_t: true,
                    q_d: true,
                    curved: true,
                },
                n_timed: 6,
                has_branches: false,
                ..::kin::emitted::Facts::of("slider_crank")
            };
            FACTS
        }
        fn arguments(&self) -> ::std::vec::Vec<::kin::emitted::Argument> {
            ::kin::emitted::arguments(
                &[
                    ::kin::emitted::Argument {
                        name: "theta3",
                        target: ::kin::emitted::Target::Coord(
                            self.theta3,
                            ::kin::emitted::Trig::Used,
                        ),
                    },
                    ::kin::emitted::Argument {
                        name: "x",
                        target: ::kin::emitted::Target::Coord(
                            self.x,
                            ::kin::emitted::Trig::Unused,
                        ),
                    },
                ],
            )
        }
        /// What depends on t and parameters alone: 8 operations
        fn at_time(&self, t: f64, timed: &mut [f64]) {
            let ::core::option::Option::Some(timed) = timed.first_chunk_mut() else {
                return
            };
            let at = ::kin::emitted::At::new(t, &[], &[]);
            let t0 = at.t * self.omega;
            let (s1, c1) = ::kin::emitted::math::sin_cos(t0);
            *timed = [
                c1,
                self.l2 * c1,
                s1,
                self.l2 * s1,
                self.l2 * (self.omega * s1),
                -(self.l2 * (self.omega * c1)),
            ];
        }
        fn residual(&self, at: &::kin::emitted::At<'_>, c: &mut [f64]) {
            let ::core::option::Option::Some([c_0, c_1]) = c.first_chunk_mut() else {
                return
            };
            let fma = ::kin::emitted::fma;
            let own: [f64; 6];
            let timed = match at.timed().first_chunk() {
                ::core::option::Option::Some(timed) => timed,
                ::core::option::Option::None => {
                    own = ::kin::emitted::timed(self, at.t);
                    &own
                }
            };
            let ::core::option::Option::Some([_, theta3_sin, theta3_cos]) = at.state(0)
            else { return };
            let ::core::option::Option::Some([x_arg, _, _]) = at.state(1) else {
                return
            };
            let put = ::kin::emitted::put;
            let theta3_cos = *theta3_cos;
            let x_arg = *x_arg;
            put(c_0, fma(self.l3, theta3_cos, timed[1]) - x_arg);
            let theta3_sin = *theta3_sin;
            put(c_1, fma(self.l3, theta3_sin, timed[3]) - self.h);
        }
        fn jacobian(&self, at: &::kin::emitted::At<'_>, c_q: &mut [f64]) {
            self.linearize(at, &mut [0.0; 2], c_q);
        }
        /// C and C_q: 6 operations
        fn linearize(
            &self,
            at: &::kin::emitted::At<'_>,
            c: &mut [f64],
            c_q: &mut [f64],
        ) {
            let ::core::option::Option::Some([c_0, c_1]) = c.first_chunk_mut() else {
                return
            };
            let ::core::option::Option::Some([c_q_0, c_q_1, c_q_2]) = c_q
                .first_chunk_mut() else { return };
            let own: [f64; 6];
            let timed = match at.timed().first_chunk() {
                ::core::option::Option::Some(timed) => timed,
                ::core::option::Option::None => {
                    own = ::kin::emitted::timed(self, at.t);
                    &own
                }
            };
            let ::core::option::Option::Some([_, theta3_sin, theta3_cos]) = at.state(0)
            else { return };
            let ::core::option::Option::Some([x_arg, _, _]) = at.state(1) else {
                return
            };
            let put = ::kin::emitted::put;
            *c_q_1 = -1.0;
            let theta3_cos = *theta3_cos;
            let t0 = self.l3 * theta3_cos;
            put(c_q_2, t0);
            let x_arg = *x_arg;
            put(c_0, (t0 - x_arg) + timed[1]);
            let theta3_sin = *theta3_sin;
            let t1 = self.l3 * theta3_sin;
            put(c_q_0, -t1);
            put(c_1, (t1 - self.h) + timed[3]);
        }
        /// −C_t: 0 operations
        fn velocity_rhs(&self, at: &::kin::emitted::At<'_>, rhs: &mut [f64]) {
            let ::core::option::Option::Some([rhs_0, rhs_1]) = rhs.first_chunk_mut()
            else { return };
            let own: [f64; 6];
            let timed = match at.timed().first_chunk() {
                ::core::option::Option::Some(timed) => timed,
                ::core::option::Option::None => {
                    own = ::kin::emitted::timed(self, at.t);
                    &own
                }
            };
            let put = ::kin::emitted::put;
            *rhs_0 = timed[4];
            *rhs_1 = timed[5];
        }
        /// Q_d for t_dot = 1: 12 operations
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
            let own: [f64; 6];
            let timed = match at.timed().first_chunk() {
                ::core::option::Option::Some(timed) => timed,
                ::core::option::Option::None => {
                    own = ::kin::emitted::timed(self, at.t);
                    &own
                }
            };
            let ::core::option::Option::Some([_, theta3_sin, theta3_cos]) = at.state(0)
            else { return };
            let ::core::option::Option::Some([theta3_d]) = qd.of(0) else { return };
            let put = ::kin::emitted::put;
            let theta3_d = *theta3_d;
            let t0 = theta3_d * theta3_d;
            let t1 = self.omega * t_dot;
            let theta3_cos = *theta3_cos;
            put(q_d_0, fma(self.l2, t1 * (timed[0] * t1), self.l3 * (theta3_cos * t0)));
            let theta3_sin = *theta3_sin;
            put(q_d_1, fma(self.l2, t1 * (timed[2] * t1), self.l3 * (theta3_sin * t0)));
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
    impl ::kin::emitted::Parameters for slider_crank {
        fn parameters(&self, visit: &mut dyn FnMut(&str, f64)) {
            ::kin::emitted::visit(
                &[
                    ("l2", &self.l2),
                    ("l3", &self.l3),
                    ("h", &self.h),
                    ("omega", &self.omega),
                ],
                visit,
            );
        }
        fn set_parameter(&mut self, name: &str, value: f64) -> bool {
            ::kin::emitted::set(
                &mut [
                    ("l2", &mut self.l2),
                    ("l3", &mut self.l3),
                    ("h", &mut self.h),
                    ("omega", &mut self.omega),
                ],
                name,
                value,
            )
        }
        fn set_parameter_at(&mut self, index: usize, value: f64) -> bool {
            ::kin::emitted::set_at(
                &mut [&mut self.l2, &mut self.l3, &mut self.h, &mut self.omega],
                index,
                value,
            )
        }
        fn take_bindings(&mut self) -> ::kin::emitted::Bindings {
            ::core::mem::take(&mut self.__bindings)
        }
        fn describe(&self, to: &mut ::kin::emitted::Describer) {
            use ::kin::emitted::{
                OutgoingBySerde as _, OutgoingConstant as _, OutgoingRefused as _,
                RefusedConstant as _,
            };
            to.put("l2", &self.l2);
            to.put("l3", &self.l3);
            to.put("h", &self.h);
            to.put("omega", &self.omega);
            to.put_text(
                ::core::module_path!(),
                "/// Loop closure of the slider-crank, crank driven at ω.      [m]\nfn slider_crank(theta3: Coord, x: Coord, t: Time, l2: f64, l3: f64, h: f64, omega: f64) ->[f64 ; 2] { let theta2 = omega * t ; [l2 * theta2 . cos () + l3 * theta3 . cos () - x , l2 * theta2 . sin () + l3 * theta3 . sin () - h] }",
            );
        }
    }
    #[allow(unused, non_snake_case, clippy::all, clippy::pedantic, clippy::nursery)]
    impl ::kin::emitted::Written for slider_crank {
        #[cold]
        fn table(
            &self,
        ) -> ::core::option::Option<
            (&'static ::kin::emitted::graph::Table, ::std::vec::Vec<f64>),
        > {
            static TABLE: ::kin::emitted::graph::Table = ::kin::emitted::graph::Table::new(
                ::core::file!(),
                r##"
at 1 1 omega * t
at 1 1 theta2.cos()
at 1 1 l2 * theta2.cos()
at 1 1 theta3.cos()
at 1 1 l3 * theta3.cos()
at 1 1 l2 * theta2.cos() + l3 * theta3.cos()
at 1 1 l2 * theta2.cos() + l3 * theta3.cos() - x
at 1 1 theta2.sin()
at 1 1 l2 * theta2.sin()
at 1 1 theta3.sin()
at 1 1 l3 * theta3.sin()
at 1 1 l2 * theta2.sin() + l3 * theta3.sin()
at 1 1 l2 * theta2.sin() + l3 * theta3.sin() - h
parameters l2 l3 h omega
rows 13 19
- Column 1
- Time
- Parameter 0
- Parameter 1
- Parameter 2
- Parameter 3
0 Product 1 5
1 Cos 6
2 Product 2 7
3 Column 0
3 Cos 9
4 Product 3 10
5 Sum 8 11
6 Difference 12 0
7 Sin 6
8 Product 2 14
9 Sin 9
10 Product 3 16
11 Sum 15 17
12 Difference 18 4"##,
            );
            TABLE.with(&[self.l2, self.l3, self.h, self.omega])
        }
    }
    #[allow(unused, non_snake_case, clippy::all, clippy::pedantic, clippy::nursery)]
    impl ::kin::emitted::Described for slider_crank {
        const KIND: &'static str = "slider_crank";
        const ARGUMENTS: &'static [::kin::emitted::ArgumentKind] = <Self as ::kin::emitted::Equation<
            2,
            2,
        >>::ARGUMENTS;
        fn read(from: &mut ::kin::emitted::Reader<'_>) -> ::core::option::Option<Self> {
            use ::kin::emitted::{IncomingBySerde as _, IncomingRefused as _};
            ::core::option::Option::Some(slider_crank {
                theta3: from.coord(),
                x: from.coord(),
                l2: from.get("l2"),
                l3: from.get("l3"),
                h: from.get("h"),
                omega: from.get("omega"),
                __bindings: ::kin::emitted::Bindings::NONE,
            })
        }
    }
    #[allow(unused, non_snake_case, clippy::all, clippy::pedantic, clippy::nursery)]
    impl ::kin::emitted::Equation<2, 2> for slider_crank {
        const ARGUMENTS: &'static [::kin::emitted::ArgumentKind] = &[
            ::kin::emitted::ArgumentKind::Coord,
            ::kin::emitted::ArgumentKind::Coord,
        ];
        fn evaluate<__D: ::kin::emitted::Dual>(
            &self,
            q: &[::kin::emitted::Real<__D>; 2],
            t: ::kin::emitted::Real<__D>,
        ) -> [::kin::emitted::Real<__D>; 2] {
            let mut q = ::kin::emitted::Columns(q);
            let theta3: __Real<__D> = q.coord();
            let x: __Real<__D> = q.coord();
            let t: __Real<__D> = t;
            let l2: __Real<__D> = ::kin::emitted::Lift::lift(self.l2);
            let l3: __Real<__D> = ::kin::emitted::Lift::lift(self.l3);
            let h: __Real<__D> = ::kin::emitted::Lift::lift(self.h);
            let omega: __Real<__D> = ::kin::emitted::Lift::lift(self.omega);
            let value = (move || -> [__Real<__D>; 2] {
                let theta2 = omega * t;
                [
                    l2 * theta2.cos() + l3 * theta3.cos() - x,
                    l2 * theta2.sin() + l3 * theta3.sin() - h,
                ]
            })();
            ::kin::emitted::rows(value)
        }
        #[inline]
        fn plain(&self, q: &[f64; 2], t: f64) -> [f64; 2] {
            let mut q = ::kin::emitted::Columns(q);
            ::kin::emitted::rows(
                __WRITTEN(q.coord(), q.coord(), t, self.l2, self.l3, self.h, self.omega),
            )
        }
    }
};
