/// The constraint that [`fn@on_cam`] makes.
///
/// Knife-edge follower: the tip stays on the cam profile ρ(φ), worn off by `wear`; φ is measured
/// from the cam's x-axis.      [m]
#[allow(non_camel_case_types, non_snake_case)]
#[derive(Clone)]
struct on_cam {
    cam: ::kin::PlanarBody,
    follower: ::kin::PlanarBody,
    tip: Vec2,
    profile: Law,
    __bindings: ::kin::emitted::Bindings,
}
/// Knife-edge follower: the tip stays on the cam profile ρ(φ), worn off by `wear`; φ is measured
/// from the cam's x-axis.      [m]
#[allow(clippy::too_many_arguments)]
#[must_use]
fn on_cam(
    cam: impl ::kin::emitted::IntoPlanarBody,
    follower: impl ::kin::emitted::IntoPlanarBody,
    tip: impl ::kin::emitted::Components<2, Scalar: ::kin::emitted::IntoNumber>,
    profile: Law,
) -> on_cam {
    let mut noted = ::kin::emitted::Bindings::NONE;
    let bindings = &mut noted;
    on_cam {
        cam: ::kin::emitted::IntoPlanarBody::into_planar_body(cam),
        follower: ::kin::emitted::IntoPlanarBody::into_planar_body(follower),
        tip: ::kin::emitted::vector(tip, "tip", bindings),
        profile: ::kin::emitted::parameter(profile, "profile", bindings),
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
        Law,
    ) -> f64 = |cam, follower, tip, profile| {
        let p = cam.local(follower.point(tip));
        let phi = p.y.atan2(p.x);
        p.norm() - profile.at(phi)
            + ::kin::emitted::returned(
                    match (phi, MOST_WEAR) {
                        (a_0, a_1) => {
                            let f = wear;
                            let how = (&::kin::emitted::Probe::new(
                                &f,
                                (::kin::emitted::of(&a_0), ::kin::emitted::of(&a_1)),
                            ))
                                .marker();
                            f(how.plain(a_0), how.plain(a_1))
                        }
                    },
                )
                .lowered()
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
    impl on_cam {
        fn __leaf0<__D: ::kin::emitted::Dual>(
            &self,
            x: [__Real<__D>; 1],
        ) -> __Real<__D> {
            (&::kin::emitted::Foreign(
                match (x[0], MOST_WEAR) {
                    (a_0, a_1) => {
                        let f = ::kin::emitted::callee::<__SOUND, _>(wear);
                        let how = (&::kin::emitted::Probe::new(
                            &f,
                            (::kin::emitted::of(&a_0), ::kin::emitted::of(&a_1)),
                        ))
                            .marker();
                        f(how.jet(a_0).argument(), how.constant(a_1))
                    }
                },
            ))
                .lifted(::core::marker::PhantomData::<__Dual<__D>>)
        }
    }
    #[allow(unused, non_snake_case, clippy::all, clippy::pedantic, clippy::nursery)]
    impl ::kin::Constraint for on_cam {
        fn facts(&self) -> ::kin::emitted::Facts<'_> {
            const FACTS: ::kin::emitted::Facts<'static> = ::kin::emitted::Facts {
                description: "Knife-edge follower: the tip stays on the cam profile ρ(φ), worn off by `wear`; φ is measured\nfrom the cam's x-axis.      [m]",
                is_driver: false,
                rows: &["1"],
                pattern: &[
                    ::kin::emitted::Entry::new(0, 0),
                    ::kin::emitted::Entry::new(0, 1),
                    ::kin::emitted::Entry::new(0, 2),
                    ::kin::emitted::Entry::new(0, 3),
                    ::kin::emitted::Entry::new(0, 4),
                    ::kin::emitted::Entry::new(0, 5),
                ],
                reason: ::kin::extend::RouteReason::ReadBut {
                    outside: &[
                        (
                            "wear",
                            ::kin::emitted::Source {
                                file: ::core::file!(),
                                line: 1,
                                column: 1,
                            },
                        ),
                    ],
                },
                dependence: ::kin::emitted::Dependence {
                    c_on_t: false,
                    c_q_on_t: false,
                    c_t: false,
                    q_d: true,
                    curved: true,
                },
                has_branches: false,
                ..::kin::emitted::Facts::of("on_cam")
            };
            FACTS
        }
        fn arguments(&self) -> ::std::vec::Vec<::kin::emitted::Argument> {
            ::kin::emitted::arguments(
                &[
                    ::kin::emitted::Argument {
                        name: "cam",
                        target: ::kin::emitted::Target::Planar(self.cam),
                    },
                    ::kin::emitted::Argument {
                        name: "follower",
                        target: ::kin::emitted::Target::Planar(self.follower),
                    },
                ],
            )
        }
        fn residual(&self, at: &::kin::emitted::At<'_>, c: &mut [f64]) {
            self.linearize(at, c, &mut [0.0; 6]);
        }
        fn jacobian(&self, at: &::kin::emitted::At<'_>, c_q: &mut [f64]) {
            self.linearize(at, &mut [0.0; 1], c_q);
        }
        /// C and C_q: 60 operations
        fn linearize(
            &self,
            at: &::kin::emitted::At<'_>,
            c: &mut [f64],
            c_q: &mut [f64],
        ) {
            let ::core::option::Option::Some([c_0]) = c.first_chunk_mut() else {
                return
            };
            let ::core::option::Option::Some(
                [c_q_0,
                c_q_1,
                c_q_2,
                c_q_3,
                c_q_4,
                c_q_5,
                ],
            ) = c_q.first_chunk_mut() else { return };
            let fma = ::kin::emitted::fma;
            let ::core::option::Option::Some([cam_x, cam_y, _, cam_sin, cam_cos]) = at
                .state(0) else { return };
            let ::core::option::Option::Some(
                [follower_x,
                follower_y,
                _,
                follower_sin,
                follower_cos,
                ],
            ) = at.state(1) else { return };
            let put = ::kin::emitted::put;
            let follower_cos = *follower_cos;
            let follower_sin = *follower_sin;
            let t0 = (self.tip.x * follower_cos) - (self.tip.y * follower_sin);
            let follower_x = *follower_x;
            let cam_x = *cam_x;
            let t1 = (follower_x + t0) - cam_x;
            let t2 = (self.tip.x * follower_sin) + (self.tip.y * follower_cos);
            let follower_y = *follower_y;
            let cam_y = *cam_y;
            let t3 = (follower_y + t2) - cam_y;
            let cam_cos = *cam_cos;
            let cam_sin = *cam_sin;
            let t4 = (cam_cos * t1) + (cam_sin * t3);
            let t5 = (cam_cos * t3) - (cam_sin * t1);
            let t6 = (t4 * t4) + (t5 * t5);
            let t7 = ::kin::emitted::math::sqrt(t6);
            let t8 = ::kin::emitted::math::atan2(t5, t4);
            let law0: [f64; 4] = self.profile.jet(t8);
            let leaf1: ::kin::emitted::Real<f64> = self
                .__leaf0([::kin::emitted::Real(t8)]);
            put(c_0, (t7 - law0[0]) + leaf1.0);
            let leaf2: ::kin::emitted::Real<::kin::emitted::Dual64> = self
                .__leaf0([::kin::emitted::Real(::kin::emitted::Dual64::new(t8, 1.0))]);
            let t9 = t4 / t6;
            let t10 = fma(t0, cam_cos, t2 * cam_sin);
            let t11 = fma(-t2, cam_cos, t0 * cam_sin);
            let t12 = t5 / t6;
            let t13 = fma(-t12, t11, t9 * t10);
            let t14 = (2.0 * 1.0) / (2.0 * t7);
            put(
                c_q_5,
                fma(t14, fma(t5, t10, t4 * t11), fma(-law0[1], t13, leaf2.0.eps * t13)),
            );
            put(c_q_2, fma(t5, t12, t4 * t9) * (law0[1] - leaf2.0.eps));
            let t15 = fma(cam_cos, t12, cam_sin * t9);
            let t16 = fma(
                fma(-cam_cos, t4, cam_sin * t5),
                t14,
                fma(-t15, law0[1], t15 * leaf2.0.eps),
            );
            put(c_q_0, t16);
            let t17 = fma(-cam_cos, t9, cam_sin * t12);
            let t18 = fma(
                -t14,
                fma(cam_cos, t5, cam_sin * t4),
                fma(-law0[1], t17, leaf2.0.eps * t17),
            );
            put(c_q_1, t18);
            *c_q_3 = -t16;
            *c_q_4 = -t18;
        }
        fn velocity_rhs(&self, _at: &::kin::emitted::At<'_>, rhs: &mut [f64]) {
            ::kin::emitted::no_velocity(rhs, 1);
        }
        /// Q_d for t_dot = 1: 87 operations
        fn acceleration_rhs(
            &self,
            at: &::kin::emitted::At<'_>,
            qd: &::kin::emitted::Rates<'_>,
            t_dot: f64,
            q_d: &mut [f64],
        ) {
            let ::core::option::Option::Some([q_d_0]) = q_d.first_chunk_mut() else {
                return
            };
            let fma = ::kin::emitted::fma;
            let ::core::option::Option::Some([cam_x, cam_y, _, cam_sin, cam_cos]) = at
                .state(0) else { return };
            let ::core::option::Option::Some(
                [follower_x,
                follower_y,
                _,
                follower_sin,
                follower_cos,
                ],
            ) = at.state(1) else { return };
            let ::core::option::Option::Some([cam_x_d, cam_y_d, cam_theta_d]) = qd.of(0)
            else { return };
            let ::core::option::Option::Some(
                [follower_x_d,
                follower_y_d,
                follower_theta_d,
                ],
            ) = qd.of(1) else { return };
            let follower_sin = *follower_sin;
            let follower_cos = *follower_cos;
            let t0 = (self.tip.x * follower_sin) + (self.tip.y * follower_cos);
            let follower_y = *follower_y;
            let cam_y = *cam_y;
            let t1 = (follower_y + t0) - cam_y;
            let t2 = (self.tip.x * follower_cos) - (self.tip.y * follower_sin);
            let follower_x = *follower_x;
            let cam_x = *cam_x;
            let t3 = (follower_x + t2) - cam_x;
            let cam_cos = *cam_cos;
            let cam_sin = *cam_sin;
            let t4 = (cam_cos * t1) - (cam_sin * t3);
            let t5 = (cam_cos * t3) + (cam_sin * t1);
            let t6 = ::kin::emitted::math::atan2(t4, t5);
            let t7 = (t5 * t5) + (t4 * t4);
            let t8 = t5 / t7;
            let follower_theta_d = *follower_theta_d;
            let t9 = t0 * follower_theta_d;
            let follower_x_d = *follower_x_d;
            let cam_x_d = *cam_x_d;
            let t10 = (follower_x_d - t9) - cam_x_d;
            let t11 = cam_sin * t10;
            let cam_theta_d = *cam_theta_d;
            let t12 = cam_cos * cam_theta_d;
            let t13 = cam_sin * cam_theta_d;
            let t14 = t2 * follower_theta_d;
            let follower_y_d = *follower_y_d;
            let cam_y_d = *cam_y_d;
            let t15 = (follower_y_d + t14) - cam_y_d;
            let t16 = fma(cam_cos, t15, fma(-t1, t13, fma(-t3, t12, -t11)));
            let t17 = cam_cos * t10;
            let t18 = fma(cam_sin, t15, fma(t1, t12, fma(-t3, t13, t17)));
            let t19 = t4 / t7;
            let t20 = fma(-t19, t18, t8 * t16);
            let t21 = fma(t4, t16, t5 * t18);
            let t22 = fma(follower_theta_d, t14, cam_theta_d * (t3 * cam_theta_d));
            let t23 = fma(follower_theta_d, t9, cam_theta_d * (t1 * cam_theta_d));
            let t24 = fma(
                -2.0,
                cam_theta_d * fma(cam_sin, t15, t17),
                fma(-cam_cos, t23, cam_sin * t22),
            );
            let t25 = fma(
                -t18,
                fma(-2.0, t19 * t21, t16) / t7,
                fma(t8, t24, t16 * (fma(-2.0, t8 * t21, t18) / t7)),
            );
            let t26 = fma(
                -cam_sin,
                t23,
                fma(-cam_cos, t22, 2.0 * (cam_theta_d * fma(cam_cos, t15, -t11))),
            );
            let t27 = fma(-t19, t26, t25);
            let leaf0: ::kin::emitted::Real<::kin::emitted::Dual2_64> = self
                .__leaf0([
                    ::kin::emitted::Real(::kin::emitted::Dual2_64::new(t6, t20, t27)),
                ]);
            let t28 = 2.0 * ::kin::emitted::math::sqrt(t7);
            let t29 = 1.0 / t28;
            let t30 = fma(
                -t21,
                (4.0 * (t29 * (t29 * t21))) / t28,
                t29 * fma(t4, t24, fma(t16, t16, fma(t5, t26, t18 * t18))),
            );
            let law1: [f64; 4] = self.profile.jet(t6);
            *q_d_0 = fma(
                law1[1],
                t27,
                fma(t20, t20 * law1[2], fma(-2.0, t30, -leaf0.0.v2)),
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
    impl ::kin::emitted::Parameters for on_cam {
        fn parameters(&self, visit: &mut dyn FnMut(&str, f64)) {
            ::kin::emitted::visit(
                &[("tip", &self.tip), ("profile", &self.profile)],
                visit,
            );
        }
        fn set_parameter(&mut self, name: &str, value: f64) -> bool {
            ::kin::emitted::set(
                &mut [("tip", &mut self.tip), ("profile", &mut self.profile)],
                name,
                value,
            )
        }
        fn set_parameter_at(&mut self, index: usize, value: f64) -> bool {
            ::kin::emitted::set_at(&mut [&mut self.tip, &mut self.profile], index, value)
        }
        fn set_law(&mut self, name: &str, law: &::kin::Law) -> bool {
            ::kin::emitted::set_law(&mut [("profile", &mut self.profile)], name, law)
        }
        #[cold]
        fn refusal(&self) -> ::core::option::Option<::std::string::String> {
            if let ::core::option::Option::Some(why) = ::kin::emitted::refusal(
                &[("profile", &self.profile)],
            ) {
                return ::core::option::Option::Some(why);
            }
            ::core::option::Option::None
        }
        fn take_bindings(&mut self) -> ::kin::emitted::Bindings {
            ::core::mem::take(&mut self.__bindings)
        }
        fn describe(&self, to: &mut ::kin::emitted::Describer) {
            use ::kin::emitted::{
                OutgoingBySerde as _, OutgoingConstant as _, OutgoingRefused as _,
                RefusedConstant as _,
            };
            to.put("tip", &self.tip);
            to.put("profile", &self.profile);
            to.put_text(
                ::core::module_path!(),
                "/// Knife-edge follower: the tip stays on the cam profile ρ(φ), worn off by `wear`; φ is measured\n/// from the cam's x-axis.      [m]\nfn on_cam(cam: Planar, follower: Planar, tip: Vec2, profile: Law) -> f64 { let p = cam . local (follower . point (tip)) ; let phi = p . y . atan2 (p . x) ; p . norm () - profile . at (phi) + wear (phi , MOST_WEAR) }",
            );
            (&::kin::emitted::Outgoing(&MOST_WEAR)).constant("MOST_WEAR", to);
            to.lacks("`wear` (`#[helper]` before it and `#[constraint(with = wear)]`)");
        }
    }
    #[allow(unused, non_snake_case, clippy::all, clippy::pedantic, clippy::nursery)]
    impl ::kin::emitted::Written for on_cam {
        fn laws(
            &self,
            at: &::kin::emitted::At<'_>,
            visit: &mut dyn FnMut(&str, &::kin::Law, f64),
        ) {
            let ::core::option::Option::Some([cam_x, cam_y, _, cam_sin, cam_cos]) = at
                .state(0) else { return };
            let ::core::option::Option::Some(
                [follower_x,
                follower_y,
                _,
                follower_sin,
                follower_cos,
                ],
            ) = at.state(1) else { return };
            let follower_y = *follower_y;
            let follower_sin = *follower_sin;
            let follower_cos = *follower_cos;
            let cam_y = *cam_y;
            let t0 = (follower_y
                + ((self.tip.x * follower_sin) + (self.tip.y * follower_cos))) - cam_y;
            let follower_x = *follower_x;
            let cam_x = *cam_x;
            let t1 = (follower_x
                + ((self.tip.x * follower_cos) - (self.tip.y * follower_sin))) - cam_x;
            let cam_cos = *cam_cos;
            let cam_sin = *cam_sin;
            let [x_0] = [
                ::kin::emitted::math::atan2(
                    (cam_cos * t0) - (cam_sin * t1),
                    (cam_cos * t1) + (cam_sin * t0),
                ),
            ];
            visit("profile", &self.profile, x_0);
        }
        #[cold]
        fn table(
            &self,
        ) -> ::core::option::Option<
            (&'static ::kin::emitted::graph::Table, ::std::vec::Vec<f64>),
        > {
            static TABLE: ::kin::emitted::graph::Table = ::kin::emitted::graph::Table::new(
                ::core::file!(),
                r##"
at 1 1 follower.point(tip)
at 1 1 cam.local(follower.point(tip))
at 1 1 p.y.atan2(p.x)
at 1 1 p.norm()
at 1 1 profile.at(phi)
at 1 1 p.norm() - profile.at(phi)
at 1 1 wear(phi, MOST_WEAR)
at 1 1 p.norm() - profile.at(phi) + wear(phi, MOST_WEAR)
parameters tip.x tip.y
rows 36
- Parameter 0
- Parameter 1
0 Column 3
0 Column 4
0 Column 5
0 Sin 4
0 Cos 4
0 Product 0 6
0 Product 1 5
0 Difference 7 8
0 Product 0 5
0 Product 1 6
0 Sum 10 11
0 Sum 2 9
0 Sum 3 12
1 Column 0
1 Column 1
1 Column 2
1 Sin 17
1 Cos 17
1 Difference 13 15
1 Difference 14 16
1 Product 19 20
1 Product 18 21
1 Sum 22 23
1 Product 18 20
1 Product 19 21
1 Difference 26 25
2 Atan2 27 24
3 Product 24 24
3 Product 27 27
3 Sum 29 30
3 Sqrt 31
4 Law 0 28 0
5 Difference 32 33
6 Foreign 1 0 28
7 Sum 34 35"##,
            );
            TABLE.with(&[self.tip.x, self.tip.y])
        }
        #[cold]
        fn outside(
            &self,
            number: usize,
            x: &[::kin::emitted::graph::Dual3_64],
            to: &mut ::kin::emitted::graph::Given,
        ) {
            match number {
                0 => ::kin::emitted::graph::give_law(&self.profile, x, to),
                1 => {
                    let value: ::kin::emitted::Real<::kin::emitted::Dual3_64> = self
                        .__leaf0([::kin::emitted::Real(x[0])]);
                    to.push(value.0);
                }
                _ => {}
            }
        }
        fn attachments(&self) -> ::std::vec::Vec<::kin::emitted::Attachment> {
            ::kin::emitted::attachments(
                &[::kin::emitted::point(1, [self.tip.x, self.tip.y, 0.0])],
            )
        }
    }
    #[allow(unused, non_snake_case, clippy::all, clippy::pedantic, clippy::nursery)]
    impl ::kin::emitted::Described for on_cam {
        const KIND: &'static str = "on_cam";
        const ARGUMENTS: &'static [::kin::emitted::ArgumentKind] = <Self as ::kin::emitted::Equation<
            6,
            1,
        >>::ARGUMENTS;
        fn read(from: &mut ::kin::emitted::Reader<'_>) -> ::core::option::Option<Self> {
            use ::kin::emitted::{IncomingBySerde as _, IncomingRefused as _};
            ::core::option::Option::Some(on_cam {
                cam: from.planar(),
                follower: from.planar(),
                tip: from.get("tip"),
                profile: from.get("profile"),
                __bindings: ::kin::emitted::Bindings::NONE,
            })
        }
    }
    #[allow(unused, non_snake_case, clippy::all, clippy::pedantic, clippy::nursery)]
    impl ::kin::emitted::Equation<6, 1> for on_cam {
        const ARGUMENTS: &'static [::kin::emitted::ArgumentKind] = &[
            ::kin::emitted::ArgumentKind::Planar,
            ::kin::emitted::ArgumentKind::Planar,
        ];
        fn evaluate<__D: ::kin::emitted::Dual>(
            &self,
            q: &[::kin::emitted::Real<__D>; 6],
            t: ::kin::emitted::Real<__D>,
        ) -> [::kin::emitted::Real<__D>; 1] {
            let mut q = ::kin::emitted::Columns(q);
            let cam: ::kin::emitted::PlanarState<__Real<__D>> = q.planar();
            let follower: ::kin::emitted::PlanarState<__Real<__D>> = q.planar();
            let tip: ::kin::emitted::Vec2<__Real<__D>> = ::kin::emitted::Lift::lift(
                self.tip,
            );
            let profile = self.profile.clone();
            let value = (move || -> __Real<__D> {
                let p = cam.local(follower.point(tip));
                let phi = p.y.atan2(p.x);
                p.norm() - profile.at(phi)
                    + (&::kin::emitted::Foreign(
                        ::kin::emitted::callee::<
                            __SOUND,
                            _,
                        >(
                            wear,
                        )(
                            ::kin::emitted::Jet(phi).argument(),
                            ::kin::emitted::constant_argument(MOST_WEAR),
                        ),
                    ))
                        .lifted(::core::marker::PhantomData::<__Dual<__D>>)
            })();
            ::kin::emitted::rows(value)
        }
        #[inline]
        fn plain(&self, q: &[f64; 6], t: f64) -> [f64; 1] {
            let mut q = ::kin::emitted::Columns(q);
            ::kin::emitted::rows(
                __WRITTEN(
                    q.planar(),
                    q.planar(),
                    self.tip,
                    ::core::clone::Clone::clone(&self.profile),
                ),
            )
        }
    }
};
