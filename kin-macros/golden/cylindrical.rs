/// The constraint that [`fn@cylindrical`] makes.
///
/// A cylindrical joint: the axes are parallel and the line between two of their points is along
/// them.      [–, –, m, m]
#[allow(non_camel_case_types, non_snake_case)]
#[derive(Clone)]
pub struct cylindrical {
    i: ::kin::SpatialBody,
    j: ::kin::SpatialBody,
    u_i: Vec3,
    u_j: Vec3,
    f_i: Vec3,
    g_i: Vec3,
    h_j: Vec3,
    __bindings: ::kin::emitted::Bindings,
}
/// A cylindrical joint: the axes are parallel and the line between two of their points is along
/// them.      [–, –, m, m]
#[allow(clippy::too_many_arguments)]
#[must_use]
pub fn cylindrical(
    i: impl ::kin::emitted::IntoSpatialBody,
    j: impl ::kin::emitted::IntoSpatialBody,
    u_i: impl ::kin::emitted::Components<3, Scalar: ::kin::emitted::IntoNumber>,
    u_j: impl ::kin::emitted::Components<3, Scalar: ::kin::emitted::IntoNumber>,
    f_i: impl ::kin::emitted::Components<3, Scalar: ::kin::emitted::IntoNumber>,
    g_i: impl ::kin::emitted::Components<3, Scalar: ::kin::emitted::IntoNumber>,
    h_j: impl ::kin::emitted::Components<3, Scalar: ::kin::emitted::IntoNumber>,
) -> cylindrical {
    let mut noted = ::kin::emitted::Bindings::NONE;
    let bindings = &mut noted;
    cylindrical {
        i: ::kin::emitted::IntoSpatialBody::into_spatial_body(i),
        j: ::kin::emitted::IntoSpatialBody::into_spatial_body(j),
        u_i: ::kin::emitted::vector(u_i, "u_i", bindings),
        u_j: ::kin::emitted::vector(u_j, "u_j", bindings),
        f_i: ::kin::emitted::vector(f_i, "f_i", bindings),
        g_i: ::kin::emitted::vector(g_i, "g_i", bindings),
        h_j: ::kin::emitted::vector(h_j, "h_j", bindings),
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
        ::kin::emitted::SpatialState,
        ::kin::emitted::SpatialState,
        Vec3,
        Vec3,
        Vec3,
        Vec3,
        Vec3,
    ) -> (f64, f64, f64, f64) = |i, j, u_i, u_j, f_i, g_i, h_j| {
        let f = i.direction(f_i);
        let g = i.direction(g_i);
        let h = j.direction(h_j);
        let d = i.point(u_i) - j.point(u_j);
        (f.dot(h), g.dot(h), f.dot(d), g.dot(d))
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
    impl ::kin::Constraint for cylindrical {
        fn facts(&self) -> ::kin::emitted::Facts<'_> {
            const FACTS: ::kin::emitted::Facts<'static> = ::kin::emitted::Facts {
                description: "A cylindrical joint: the axes are parallel and the line between two of their points is along\nthem.      [–, –, m, m]",
                is_driver: false,
                rows: &["1", "2", "3", "4"],
                pattern: &[
                    ::kin::emitted::Entry::new(0, 3),
                    ::kin::emitted::Entry::new(0, 4),
                    ::kin::emitted::Entry::new(0, 5),
                    ::kin::emitted::Entry::new(0, 6),
                    ::kin::emitted::Entry::new(0, 10),
                    ::kin::emitted::Entry::new(0, 11),
                    ::kin::emitted::Entry::new(0, 12),
                    ::kin::emitted::Entry::new(0, 13),
                    ::kin::emitted::Entry::new(1, 3),
                    ::kin::emitted::Entry::new(1, 4),
                    ::kin::emitted::Entry::new(1, 5),
                    ::kin::emitted::Entry::new(1, 6),
                    ::kin::emitted::Entry::new(1, 10),
                    ::kin::emitted::Entry::new(1, 11),
                    ::kin::emitted::Entry::new(1, 12),
                    ::kin::emitted::Entry::new(1, 13),
                    ::kin::emitted::Entry::new(2, 0),
                    ::kin::emitted::Entry::new(2, 1),
                    ::kin::emitted::Entry::new(2, 2),
                    ::kin::emitted::Entry::new(2, 3),
                    ::kin::emitted::Entry::new(2, 4),
                    ::kin::emitted::Entry::new(2, 5),
                    ::kin::emitted::Entry::new(2, 6),
                    ::kin::emitted::Entry::new(2, 7),
                    ::kin::emitted::Entry::new(2, 8),
                    ::kin::emitted::Entry::new(2, 9),
                    ::kin::emitted::Entry::new(2, 10),
                    ::kin::emitted::Entry::new(2, 11),
                    ::kin::emitted::Entry::new(2, 12),
                    ::kin::emitted::Entry::new(2, 13),
                    ::kin::emitted::Entry::new(3, 0),
                    ::kin::emitted::Entry::new(3, 1),
                    ::kin::emitted::Entry::new(3, 2),
                    ::kin::emitted::Entry::new(3, 3),
                    ::kin::emitted::Entry::new(3, 4),
                    ::kin::emitted::Entry::new(3, 5),
                    ::kin::emitted::Entry::new(3, 6),
                    ::kin::emitted::Entry::new(3, 7),
                    ::kin::emitted::Entry::new(3, 8),
                    ::kin::emitted::Entry::new(3, 9),
                    ::kin::emitted::Entry::new(3, 10),
                    ::kin::emitted::Entry::new(3, 11),
                    ::kin::emitted::Entry::new(3, 12),
                    ::kin::emitted::Entry::new(3, 13),
                ],
                reason: ::kin::extend::RouteReason::Read,
                dependence: ::kin::emitted::Dependence {
                    c_on_t: false,
                    c_q_on_t: false,
                    c_t: false,
                    q_d: true,
                    curved: true,
                },
                has_branches: false,
                ..::kin::emitted::Facts::of("cylindrical")
            };
            FACTS
        }
        fn arguments(&self) -> ::std::vec::Vec<::kin::emitted::Argument> {
            ::kin::emitted::arguments(
                &[
                    ::kin::emitted::Argument {
                        name: "i",
                        target: ::kin::emitted::Target::Spatial(self.i),
                    },
                    ::kin::emitted::Argument {
                        name: "j",
                        target: ::kin::emitted::Target::Spatial(self.j),
                    },
                ],
            )
        }
        fn residual(&self, at: &::kin::emitted::At<'_>, c: &mut [f64]) {
            self.linearize(at, c, &mut [0.0; 44]);
        }
        fn jacobian(&self, at: &::kin::emitted::At<'_>, c_q: &mut [f64]) {
            self.linearize(at, &mut [0.0; 4], c_q);
        }
        /// C and C_q: 284 operations
        fn linearize(
            &self,
            at: &::kin::emitted::At<'_>,
            c: &mut [f64],
            c_q: &mut [f64],
        ) {
            let ::core::option::Option::Some([c_0, c_1, c_2, c_3]) = c.first_chunk_mut()
            else { return };
            let ::core::option::Option::Some(
                [c_q_0,
                c_q_1,
                c_q_2,
                c_q_3,
                c_q_4,
                c_q_5,
                c_q_6,
                c_q_7,
                c_q_8,
                c_q_9,
                c_q_10,
                c_q_11,
                c_q_12,
                c_q_13,
                c_q_14,
                c_q_15,
                c_q_16,
                c_q_17,
                c_q_18,
                c_q_19,
                c_q_20,
                c_q_21,
                c_q_22,
                c_q_23,
                c_q_24,
                c_q_25,
                c_q_26,
                c_q_27,
                c_q_28,
                c_q_29,
                c_q_30,
                c_q_31,
                c_q_32,
                c_q_33,
                c_q_34,
                c_q_35,
                c_q_36,
                c_q_37,
                c_q_38,
                c_q_39,
                c_q_40,
                c_q_41,
                c_q_42,
                c_q_43,
                ],
            ) = c_q.first_chunk_mut() else { return };
            let fma = ::kin::emitted::fma;
            let ::core::option::Option::Some([i_x, i_y, i_z, i_e0, i_e1, i_e2, i_e3]) = at
                .state(0) else { return };
            let ::core::option::Option::Some([j_x, j_y, j_z, j_e0, j_e1, j_e2, j_e3]) = at
                .state(1) else { return };
            let put = ::kin::emitted::put;
            let i_e0 = *i_e0;
            let t0 = 2.0 * i_e0;
            let t1 = self.f_i.x * t0;
            let i_e3 = *i_e3;
            let t2 = 2.0 * i_e3;
            let t3 = fma(-self.f_i.y, t2, t1);
            let i_e2 = *i_e2;
            let t4 = 2.0 * i_e2;
            let t5 = fma(self.f_i.z, t4, t3);
            let i_e1 = *i_e1;
            let t6 = 2.0 * i_e1;
            let t7 = fma(self.f_i.z, t2, fma(self.f_i.y, t4, self.f_i.x * t6));
            let t8 = fma(i_e1, t7, fma(i_e0, t5, -self.f_i.x));
            put(c_q_16, t8);
            *c_q_23 = -t8;
            let t9 = self.f_i.y * t0;
            let t10 = fma(-self.f_i.z, t6, t9);
            let t11 = fma(self.f_i.x, t2, t10);
            let t12 = fma(i_e2, t7, fma(i_e0, t11, -self.f_i.y));
            put(c_q_17, t12);
            *c_q_24 = -t12;
            let t13 = self.f_i.z * t0;
            let t14 = fma(-self.f_i.x, t4, t13);
            let t15 = fma(self.f_i.y, t6, t14);
            let t16 = fma(i_e3, t7, fma(i_e0, t15, -self.f_i.z));
            put(c_q_18, t16);
            *c_q_25 = -t16;
            let t17 = self.g_i.x * t0;
            let t18 = fma(-self.g_i.y, t2, t17);
            let t19 = fma(self.g_i.z, t4, t18);
            let t20 = fma(self.g_i.z, t2, fma(self.g_i.y, t4, self.g_i.x * t6));
            let t21 = fma(i_e1, t20, fma(i_e0, t19, -self.g_i.x));
            put(c_q_30, t21);
            *c_q_37 = -t21;
            let t22 = self.g_i.y * t0;
            let t23 = fma(-self.g_i.z, t6, t22);
            let t24 = fma(self.g_i.x, t2, t23);
            let t25 = fma(i_e2, t20, fma(i_e0, t24, -self.g_i.y));
            put(c_q_31, t25);
            *c_q_38 = -t25;
            let t26 = self.g_i.z * t0;
            let t27 = fma(-self.g_i.x, t4, t26);
            let t28 = fma(self.g_i.y, t6, t27);
            let t29 = fma(i_e3, t20, fma(i_e0, t28, -self.g_i.z));
            put(c_q_32, t29);
            *c_q_39 = -t29;
            let j_e0 = *j_e0;
            let t30 = 2.0 * j_e0;
            let t31 = self.h_j.x * t30;
            let j_e2 = *j_e2;
            let t32 = 2.0 * j_e2;
            let t33 = fma(self.h_j.z, t32, t31);
            let t34 = self.h_j.y * t30;
            let j_e1 = *j_e1;
            let t35 = 2.0 * j_e1;
            let t36 = fma(-self.h_j.z, t35, t34);
            let j_e3 = *j_e3;
            let t37 = 2.0 * j_e3;
            let t38 = fma(self.h_j.z, t37, fma(self.h_j.y, t32, self.h_j.x * t35));
            let t39 = fma(self.h_j.z, t37, t38);
            put(c_q_7, fma(t16, t39, fma(-t8, t36, t12 * t33)));
            put(c_q_15, fma(t29, t39, fma(-t21, t36, t25 * t33)));
            let t40 = fma(self.h_j.x, t35, t38);
            let t41 = self.h_j.z * t30;
            let t42 = fma(-self.h_j.x, t32, t41);
            let t43 = fma(self.h_j.x, t37, t34);
            put(c_q_5, fma(t16, t43, fma(-t12, t42, t8 * t40)));
            put(c_q_13, fma(t29, t43, fma(-t25, t42, t21 * t40)));
            let t44 = fma(self.h_j.y, t35, t41);
            let t45 = fma(self.h_j.y, t32, t38);
            let t46 = fma(-self.h_j.y, t37, t31);
            put(c_q_6, fma(-t16, t46, fma(t12, t45, t8 * t44)));
            put(c_q_14, fma(-t29, t46, fma(t25, t45, t21 * t44)));
            let t47 = fma(self.h_j.z, t32, t46);
            let t48 = t31 + t47;
            let t49 = fma(self.h_j.x, t37, t36);
            let t50 = t34 + t49;
            let t51 = fma(self.h_j.y, t35, t42);
            let t52 = t41 + t51;
            put(c_q_4, fma(t16, t52, fma(t12, t50, t8 * t48)));
            put(c_q_12, fma(t29, t52, fma(t25, t50, t21 * t48)));
            let t53 = fma(j_e1, t38, fma(j_e0, t47, -self.h_j.x));
            let t54 = fma(j_e2, t38, fma(j_e0, t49, -self.h_j.y));
            let t55 = fma(j_e3, t38, fma(j_e0, t51, -self.h_j.z));
            put(c_0, fma(t16, t55, fma(t12, t54, t8 * t53)));
            put(c_1, fma(t29, t55, fma(t25, t54, t21 * t53)));
            let t56 = t1 + t5;
            let t57 = t9 + t11;
            let t58 = t13 + t15;
            put(c_q_0, fma(t55, t58, fma(t54, t57, t53 * t56)));
            let t59 = fma(self.f_i.z, t4, t1);
            let t60 = fma(self.f_i.z, t2, t7);
            put(c_q_3, fma(t55, t60, fma(-t10, t53, t54 * t59)));
            let t61 = fma(self.f_i.y, t6, t13);
            let t62 = fma(self.f_i.y, t4, t7);
            put(c_q_2, fma(-t3, t55, fma(t54, t62, t53 * t61)));
            let t63 = fma(self.f_i.x, t6, t7);
            let t64 = fma(self.f_i.x, t2, t9);
            put(c_q_1, fma(t55, t64, fma(-t14, t54, t53 * t63)));
            let t65 = t17 + t19;
            let t66 = t22 + t24;
            let t67 = t26 + t28;
            put(c_q_8, fma(t55, t67, fma(t54, t66, t53 * t65)));
            let t68 = fma(self.g_i.z, t4, t17);
            let t69 = fma(self.g_i.z, t2, t20);
            put(c_q_11, fma(t55, t69, fma(-t23, t53, t54 * t68)));
            let t70 = fma(self.g_i.y, t6, t26);
            let t71 = fma(self.g_i.y, t4, t20);
            put(c_q_10, fma(-t18, t55, fma(t54, t71, t53 * t70)));
            let t72 = fma(self.g_i.x, t6, t20);
            let t73 = fma(self.g_i.x, t2, t22);
            put(c_q_9, fma(t55, t73, fma(-t27, t54, t53 * t72)));
            let t74 = self.u_j.x * t30;
            let t75 = fma(-self.u_j.y, t37, t74);
            let t76 = self.u_j.z * t30;
            let t77 = fma(self.u_j.y, t35, t76);
            let t78 = fma(self.u_j.z, t37, fma(self.u_j.y, t32, self.u_j.x * t35));
            let t79 = fma(self.u_j.y, t32, t78);
            put(c_q_28, fma(-t12, t79, fma(-t8, t77, t16 * t75)));
            put(c_q_42, fma(-t25, t79, fma(-t21, t77, t29 * t75)));
            let t80 = fma(-self.u_j.x, t32, t76);
            let t81 = fma(self.u_j.x, t35, t78);
            let t82 = self.u_j.y * t30;
            let t83 = fma(self.u_j.x, t37, t82);
            put(c_q_27, fma(-t16, t83, fma(-t8, t81, t12 * t80)));
            put(c_q_41, fma(-t29, t83, fma(-t21, t81, t25 * t80)));
            let t84 = fma(self.u_j.z, t32, t75);
            let t85 = t74 + t84;
            let t86 = fma(-self.u_j.z, t35, t82);
            let t87 = fma(self.u_j.x, t37, t86);
            let t88 = t82 + t87;
            let t89 = fma(self.u_j.y, t35, t80);
            let t90 = t76 + t89;
            put(c_q_26, fma(-t16, t90, fma(-t12, t88, -(t8 * t85))));
            put(c_q_40, fma(-t29, t90, fma(-t25, t88, -(t21 * t85))));
            let t91 = fma(self.u_j.z, t32, t74);
            let t92 = fma(self.u_j.z, t37, t78);
            put(c_q_29, fma(-t16, t92, fma(-t12, t91, t8 * t86)));
            put(c_q_43, fma(-t29, t92, fma(-t25, t91, t21 * t86)));
            let t93 = self.u_i.x * t0;
            let t94 = fma(-self.u_i.y, t2, t93);
            let t95 = fma(self.u_i.z, t4, t94);
            let t96 = fma(self.u_i.z, t2, fma(self.u_i.y, t4, self.u_i.x * t6));
            let i_x = *i_x;
            let t97 = (fma(
                -j_e1,
                t78,
                fma(-j_e0, t84, fma(i_e1, t96, fma(i_e0, t95, self.u_j.x))),
            ) - self.u_i.x) + i_x;
            let j_x = *j_x;
            let t98 = t97 - j_x;
            let t99 = self.u_i.y * t0;
            let t100 = fma(-self.u_i.z, t6, t99);
            let t101 = fma(self.u_i.x, t2, t100);
            let i_y = *i_y;
            let t102 = (fma(
                -j_e2,
                t78,
                fma(-j_e0, t87, fma(i_e2, t96, fma(i_e0, t101, self.u_j.y))),
            ) - self.u_i.y) + i_y;
            let j_y = *j_y;
            let t103 = t102 - j_y;
            let t104 = self.u_i.z * t0;
            let t105 = fma(-self.u_i.x, t4, t104);
            let t106 = fma(self.u_i.y, t6, t105);
            let i_z = *i_z;
            let t107 = (fma(
                -j_e3,
                t78,
                fma(-j_e0, t89, fma(i_e3, t96, fma(i_e0, t106, self.u_j.z))),
            ) - self.u_i.z) + i_z;
            let j_z = *j_z;
            let t108 = t107 - j_z;
            put(c_2, fma(t16, t108, fma(t12, t103, t8 * t98)));
            let t109 = t93 + t95;
            let t110 = t99 + t101;
            let t111 = t104 + t106;
            let t112 = fma(
                t16,
                t111,
                fma(t108, t58, fma(t12, t110, fma(t103, t57, fma(t8, t109, t98 * t56)))),
            );
            put(c_q_19, t112);
            let t113 = fma(
                t29,
                t111,
                fma(t108, t67, fma(t25, t110, fma(t103, t66, fma(t21, t109, t98 * t65)))),
            );
            put(c_q_33, t113);
            let t114 = fma(self.u_i.z, t4, t93);
            let t115 = fma(self.u_i.z, t2, t96);
            let t116 = fma(
                t16,
                t115,
                fma(
                    t108,
                    t60,
                    fma(t12, t114, fma(-t8, t100, fma(-t10, t98, t103 * t59))),
                ),
            );
            put(c_q_22, t116);
            let t117 = fma(
                t29,
                t115,
                fma(
                    t108,
                    t69,
                    fma(t25, t114, fma(-t21, t100, fma(-t23, t98, t103 * t68))),
                ),
            );
            put(c_q_36, t117);
            let t118 = fma(self.u_i.y, t6, t104);
            let t119 = fma(self.u_i.y, t4, t96);
            let t120 = fma(
                -t16,
                t94,
                fma(-t3, t108, fma(t12, t119, fma(t103, t62, fma(t8, t118, t98 * t61)))),
            );
            put(c_q_21, t120);
            let t121 = fma(self.u_i.x, t6, t96);
            let t122 = fma(self.u_i.x, t2, t99);
            let t123 = fma(
                t16,
                t122,
                fma(
                    t108,
                    t64,
                    fma(-t12, t105, fma(-t14, t103, fma(t8, t121, t98 * t63))),
                ),
            );
            put(c_q_20, t123);
            let t124 = fma(
                -t29,
                t94,
                fma(
                    -t18,
                    t108,
                    fma(t25, t119, fma(t103, t71, fma(t21, t118, t98 * t70))),
                ),
            );
            put(c_q_35, t124);
            let t125 = fma(
                t29,
                t122,
                fma(
                    t108,
                    t73,
                    fma(-t25, t105, fma(-t27, t103, fma(t21, t121, t98 * t72))),
                ),
            );
            put(c_q_34, t125);
            put(c_3, fma(t29, t108, fma(t25, t103, t21 * t98)));
        }
        fn velocity_rhs(&self, _at: &::kin::emitted::At<'_>, rhs: &mut [f64]) {
            ::kin::emitted::no_velocity(rhs, 4);
        }
        /// Q_d for t_dot = 1: 315 operations
        fn acceleration_rhs(
            &self,
            at: &::kin::emitted::At<'_>,
            qd: &::kin::emitted::Rates<'_>,
            t_dot: f64,
            q_d: &mut [f64],
        ) {
            let ::core::option::Option::Some([q_d_0, q_d_1, q_d_2, q_d_3]) = q_d
                .first_chunk_mut() else { return };
            let fma = ::kin::emitted::fma;
            let ::core::option::Option::Some([i_x, i_y, i_z, i_e0, i_e1, i_e2, i_e3]) = at
                .state(0) else { return };
            let ::core::option::Option::Some([j_x, j_y, j_z, j_e0, j_e1, j_e2, j_e3]) = at
                .state(1) else { return };
            let ::core::option::Option::Some(
                [i_x_d,
                i_y_d,
                i_z_d,
                i_e0_d,
                i_e1_d,
                i_e2_d,
                i_e3_d,
                ],
            ) = qd.of(0) else { return };
            let ::core::option::Option::Some(
                [j_x_d,
                j_y_d,
                j_z_d,
                j_e0_d,
                j_e1_d,
                j_e2_d,
                j_e3_d,
                ],
            ) = qd.of(1) else { return };
            let put = ::kin::emitted::put;
            let j_e3 = *j_e3;
            let j_e2 = *j_e2;
            let j_e0 = *j_e0;
            let t0 = fma(-self.h_j.y, j_e3, fma(self.h_j.z, j_e2, self.h_j.x * j_e0));
            let j_e1 = *j_e1;
            let t1 = fma(self.h_j.z, j_e3, fma(self.h_j.y, j_e2, self.h_j.x * j_e1));
            let t2 = fma(2.0, fma(j_e1, t1, j_e0 * t0), -self.h_j.x);
            let i_e3_d = *i_e3_d;
            let i_e2_d = *i_e2_d;
            let i_e0_d = *i_e0_d;
            let t3 = fma(
                -self.f_i.y,
                i_e3_d,
                fma(self.f_i.z, i_e2_d, self.f_i.x * i_e0_d),
            );
            let i_e1_d = *i_e1_d;
            let t4 = fma(
                self.f_i.z,
                i_e3_d,
                fma(self.f_i.y, i_e2_d, self.f_i.x * i_e1_d),
            );
            let t5 = fma(i_e1_d, t4, i_e0_d * t3);
            let j_e3_d = *j_e3_d;
            let j_e2_d = *j_e2_d;
            let j_e0_d = *j_e0_d;
            let t6 = fma(
                -self.h_j.y,
                j_e3_d,
                fma(self.h_j.z, j_e2_d, self.h_j.x * j_e0_d),
            );
            let j_e1_d = *j_e1_d;
            let t7 = fma(
                self.h_j.z,
                j_e3_d,
                fma(self.h_j.y, j_e2_d, self.h_j.x * j_e1_d),
            );
            let t8 = fma(j_e1_d, t7, j_e0_d * t6);
            let i_e3 = *i_e3;
            let i_e2 = *i_e2;
            let i_e0 = *i_e0;
            let t9 = fma(-self.f_i.y, i_e3, fma(self.f_i.z, i_e2, self.f_i.x * i_e0));
            let i_e1 = *i_e1;
            let t10 = fma(self.f_i.z, i_e3, fma(self.f_i.y, i_e2, self.f_i.x * i_e1));
            let t11 = fma(2.0, fma(i_e1, t10, i_e0 * t9), -self.f_i.x);
            let t12 = fma(
                -self.f_i.z,
                i_e1_d,
                fma(self.f_i.x, i_e3_d, self.f_i.y * i_e0_d),
            );
            let t13 = fma(i_e2_d, t4, i_e0_d * t12);
            let t14 = fma(-self.h_j.z, j_e1, fma(self.h_j.x, j_e3, self.h_j.y * j_e0));
            let t15 = fma(2.0, fma(j_e2, t1, j_e0 * t14), -self.h_j.y);
            let t16 = fma(
                -self.h_j.z,
                j_e1_d,
                fma(self.h_j.x, j_e3_d, self.h_j.y * j_e0_d),
            );
            let t17 = fma(j_e2_d, t7, j_e0_d * t16);
            let t18 = fma(-self.f_i.z, i_e1, fma(self.f_i.x, i_e3, self.f_i.y * i_e0));
            let t19 = fma(2.0, fma(i_e2, t10, i_e0 * t18), -self.f_i.y);
            let t20 = fma(
                -self.f_i.x,
                i_e2_d,
                fma(self.f_i.y, i_e1_d, self.f_i.z * i_e0_d),
            );
            let t21 = fma(i_e3_d, t4, i_e0_d * t20);
            let t22 = fma(-self.h_j.x, j_e2, fma(self.h_j.y, j_e1, self.h_j.z * j_e0));
            let t23 = fma(2.0, fma(j_e3, t1, j_e0 * t22), -self.h_j.z);
            let t24 = fma(
                -self.h_j.x,
                j_e2_d,
                fma(self.h_j.y, j_e1_d, self.h_j.z * j_e0_d),
            );
            let t25 = fma(j_e3_d, t7, j_e0_d * t24);
            let t26 = fma(-self.f_i.x, i_e2, fma(self.f_i.y, i_e1, self.f_i.z * i_e0));
            let t27 = fma(2.0, fma(i_e3, t10, i_e0 * t26), -self.f_i.z);
            let t28 = fma(
                t27,
                t25,
                fma(t23, t21, fma(t19, t17, fma(t15, t13, fma(t11, t8, t2 * t5)))),
            );
            let t29 = fma(i_e1, t4, fma(t10, i_e1_d, fma(i_e0, t3, t9 * i_e0_d)));
            let t30 = fma(j_e1, t7, fma(t1, j_e1_d, fma(j_e0, t6, t0 * j_e0_d)));
            let t31 = fma(j_e2, t7, fma(t1, j_e2_d, fma(j_e0, t16, t14 * j_e0_d)));
            let t32 = fma(i_e2, t4, fma(t10, i_e2_d, fma(i_e0, t12, t18 * i_e0_d)));
            let t33 = fma(j_e3, t7, fma(t1, j_e3_d, fma(j_e0, t24, t22 * j_e0_d)));
            let t34 = fma(i_e3, t4, fma(t10, i_e3_d, fma(i_e0, t20, t26 * i_e0_d)));
            put(q_d_0, (-4.0) * fma(2.0, fma(t34, t33, fma(t32, t31, t29 * t30)), t28));
            let t35 = fma(
                -self.g_i.y,
                i_e3_d,
                fma(self.g_i.z, i_e2_d, self.g_i.x * i_e0_d),
            );
            let t36 = fma(
                self.g_i.z,
                i_e3_d,
                fma(self.g_i.y, i_e2_d, self.g_i.x * i_e1_d),
            );
            let t37 = fma(i_e1_d, t36, i_e0_d * t35);
            let t38 = fma(-self.g_i.y, i_e3, fma(self.g_i.z, i_e2, self.g_i.x * i_e0));
            let t39 = fma(self.g_i.z, i_e3, fma(self.g_i.y, i_e2, self.g_i.x * i_e1));
            let t40 = fma(2.0, fma(i_e1, t39, i_e0 * t38), -self.g_i.x);
            let t41 = fma(
                -self.g_i.z,
                i_e1_d,
                fma(self.g_i.x, i_e3_d, self.g_i.y * i_e0_d),
            );
            let t42 = fma(i_e2_d, t36, i_e0_d * t41);
            let t43 = fma(-self.g_i.z, i_e1, fma(self.g_i.x, i_e3, self.g_i.y * i_e0));
            let t44 = fma(2.0, fma(i_e2, t39, i_e0 * t43), -self.g_i.y);
            let t45 = fma(
                -self.g_i.x,
                i_e2_d,
                fma(self.g_i.y, i_e1_d, self.g_i.z * i_e0_d),
            );
            let t46 = fma(i_e3_d, t36, i_e0_d * t45);
            let t47 = fma(-self.g_i.x, i_e2, fma(self.g_i.y, i_e1, self.g_i.z * i_e0));
            let t48 = fma(2.0, fma(i_e3, t39, i_e0 * t47), -self.g_i.z);
            let t49 = fma(
                t48,
                t25,
                fma(t23, t46, fma(t44, t17, fma(t15, t42, fma(t40, t8, t2 * t37)))),
            );
            let t50 = fma(i_e1, t36, fma(t39, i_e1_d, fma(i_e0, t35, t38 * i_e0_d)));
            let t51 = fma(i_e2, t36, fma(t39, i_e2_d, fma(i_e0, t41, t43 * i_e0_d)));
            let t52 = fma(i_e3, t36, fma(t39, i_e3_d, fma(i_e0, t45, t47 * i_e0_d)));
            put(q_d_1, (-4.0) * fma(2.0, fma(t33, t52, fma(t31, t51, t30 * t50)), t49));
            let t53 = fma(-self.u_i.y, i_e3, fma(self.u_i.z, i_e2, self.u_i.x * i_e0));
            let t54 = fma(
                -self.u_i.y,
                i_e3_d,
                fma(self.u_i.z, i_e2_d, self.u_i.x * i_e0_d),
            );
            let t55 = fma(self.u_i.z, i_e3, fma(self.u_i.y, i_e2, self.u_i.x * i_e1));
            let t56 = fma(
                self.u_i.z,
                i_e3_d,
                fma(self.u_i.y, i_e2_d, self.u_i.x * i_e1_d),
            );
            let t57 = fma(-self.u_j.y, j_e3, fma(self.u_j.z, j_e2, self.u_j.x * j_e0));
            let t58 = fma(
                -self.u_j.y,
                j_e3_d,
                fma(self.u_j.z, j_e2_d, self.u_j.x * j_e0_d),
            );
            let t59 = fma(self.u_j.z, j_e3, fma(self.u_j.y, j_e2, self.u_j.x * j_e1));
            let t60 = fma(
                self.u_j.z,
                j_e3_d,
                fma(self.u_j.y, j_e2_d, self.u_j.x * j_e1_d),
            );
            let i_x_d = *i_x_d;
            let t61 = fma(
                -2.0,
                fma(j_e1, t60, fma(t59, j_e1_d, fma(j_e0, t58, t57 * j_e0_d))),
                fma(
                    2.0,
                    fma(i_e1, t56, fma(t55, i_e1_d, fma(i_e0, t54, t53 * i_e0_d))),
                    i_x_d,
                ),
            );
            let j_x_d = *j_x_d;
            let t62 = t61 - j_x_d;
            let i_x = *i_x;
            let t63 = (fma(
                -2.0,
                fma(j_e1, t59, j_e0 * t57),
                fma(2.0, fma(i_e1, t55, i_e0 * t53), self.u_j.x),
            ) - self.u_i.x) + i_x;
            let j_x = *j_x;
            let t64 = t63 - j_x;
            let t65 = fma(
                -j_e1_d,
                t60,
                fma(-j_e0_d, t58, fma(i_e1_d, t56, i_e0_d * t54)),
            );
            let t66 = fma(-self.u_i.z, i_e1, fma(self.u_i.x, i_e3, self.u_i.y * i_e0));
            let t67 = fma(
                -self.u_i.z,
                i_e1_d,
                fma(self.u_i.x, i_e3_d, self.u_i.y * i_e0_d),
            );
            let t68 = fma(-self.u_j.z, j_e1, fma(self.u_j.x, j_e3, self.u_j.y * j_e0));
            let t69 = fma(
                -self.u_j.z,
                j_e1_d,
                fma(self.u_j.x, j_e3_d, self.u_j.y * j_e0_d),
            );
            let i_y_d = *i_y_d;
            let t70 = fma(
                -2.0,
                fma(j_e2, t60, fma(t59, j_e2_d, fma(j_e0, t69, t68 * j_e0_d))),
                fma(
                    2.0,
                    fma(i_e2, t56, fma(t55, i_e2_d, fma(i_e0, t67, t66 * i_e0_d))),
                    i_y_d,
                ),
            );
            let j_y_d = *j_y_d;
            let t71 = t70 - j_y_d;
            let i_y = *i_y;
            let t72 = (fma(
                -2.0,
                fma(j_e2, t59, j_e0 * t68),
                fma(2.0, fma(i_e2, t55, i_e0 * t66), self.u_j.y),
            ) - self.u_i.y) + i_y;
            let j_y = *j_y;
            let t73 = t72 - j_y;
            let t74 = fma(
                -j_e2_d,
                t60,
                fma(-j_e0_d, t69, fma(i_e2_d, t56, i_e0_d * t67)),
            );
            let t75 = fma(
                t19,
                t74,
                fma(t73, t13, fma(t32, t71, fma(t11, t65, fma(t64, t5, t29 * t62)))),
            );
            let t76 = fma(-self.u_i.x, i_e2, fma(self.u_i.y, i_e1, self.u_i.z * i_e0));
            let t77 = fma(
                -self.u_i.x,
                i_e2_d,
                fma(self.u_i.y, i_e1_d, self.u_i.z * i_e0_d),
            );
            let t78 = fma(-self.u_j.x, j_e2, fma(self.u_j.y, j_e1, self.u_j.z * j_e0));
            let t79 = fma(
                -self.u_j.x,
                j_e2_d,
                fma(self.u_j.y, j_e1_d, self.u_j.z * j_e0_d),
            );
            let i_z_d = *i_z_d;
            let t80 = fma(
                -2.0,
                fma(j_e3, t60, fma(t59, j_e3_d, fma(j_e0, t79, t78 * j_e0_d))),
                fma(
                    2.0,
                    fma(i_e3, t56, fma(t55, i_e3_d, fma(i_e0, t77, t76 * i_e0_d))),
                    i_z_d,
                ),
            );
            let j_z_d = *j_z_d;
            let t81 = t80 - j_z_d;
            let i_z = *i_z;
            let t82 = (fma(
                -2.0,
                fma(j_e3, t59, j_e0 * t78),
                fma(2.0, fma(i_e3, t55, i_e0 * t76), self.u_j.z),
            ) - self.u_i.z) + i_z;
            let j_z = *j_z;
            let t83 = t82 - j_z;
            let t84 = fma(
                -j_e3_d,
                t60,
                fma(-j_e0_d, t79, fma(i_e3_d, t56, i_e0_d * t77)),
            );
            put(q_d_2, (-4.0) * fma(t27, t84, fma(t83, t21, fma(t34, t81, t75))));
            let t85 = fma(
                t44,
                t74,
                fma(t73, t42, fma(t51, t71, fma(t40, t65, fma(t64, t37, t50 * t62)))),
            );
            put(q_d_3, (-4.0) * fma(t48, t84, fma(t83, t46, fma(t52, t81, t85))));
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
    impl ::kin::emitted::Parameters for cylindrical {
        fn parameters(&self, visit: &mut dyn FnMut(&str, f64)) {
            ::kin::emitted::visit(
                &[
                    ("u_i", &self.u_i),
                    ("u_j", &self.u_j),
                    ("f_i", &self.f_i),
                    ("g_i", &self.g_i),
                    ("h_j", &self.h_j),
                ],
                visit,
            );
        }
        fn set_parameter(&mut self, name: &str, value: f64) -> bool {
            ::kin::emitted::set(
                &mut [
                    ("u_i", &mut self.u_i),
                    ("u_j", &mut self.u_j),
                    ("f_i", &mut self.f_i),
                    ("g_i", &mut self.g_i),
                    ("h_j", &mut self.h_j),
                ],
                name,
                value,
            )
        }
        fn set_parameter_at(&mut self, index: usize, value: f64) -> bool {
            ::kin::emitted::set_at(
                &mut [
                    &mut self.u_i,
                    &mut self.u_j,
                    &mut self.f_i,
                    &mut self.g_i,
                    &mut self.h_j,
                ],
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
            to.put("u_i", &self.u_i);
            to.put("u_j", &self.u_j);
            to.put("f_i", &self.f_i);
            to.put("g_i", &self.g_i);
            to.put("h_j", &self.h_j);
            to.put_text(
                ::core::module_path!(),
                "/// A cylindrical joint: the axes are parallel and the line between two of their points is along\n/// them.      [–, –, m, m]\npub fn cylindrical(i: Spatial, j: Spatial, u_i: Vec3, u_j: Vec3, f_i: Vec3, g_i: Vec3, h_j: Vec3) ->(f64, f64, f64, f64) { let f = i . direction (f_i) ; let g = i . direction (g_i) ; let h = j . direction (h_j) ; let d = i . point (u_i) - j . point (u_j) ; (f . dot (h) , g . dot (h) , f . dot (d) , g . dot (d)) }",
            );
        }
    }
    #[allow(unused, non_snake_case, clippy::all, clippy::pedantic, clippy::nursery)]
    impl ::kin::emitted::Written for cylindrical {
        #[cold]
        fn table(
            &self,
        ) -> ::core::option::Option<
            (&'static ::kin::emitted::graph::Table, ::std::vec::Vec<f64>),
        > {
            static TABLE: ::kin::emitted::graph::Table = ::kin::emitted::graph::Table::new(
                ::core::file!(),
                r##"
at 1 1 i.direction(f_i)
at 1 1 i.direction(g_i)
at 1 1 j.direction(h_j)
at 1 1 i.point(u_i)
at 1 1 j.point(u_j)
at 1 1 i.point(u_i) - j.point(u_j)
at 1 1 f.dot(h)
at 1 1 g.dot(h)
at 1 1 f.dot(d)
at 1 1 g.dot(d)
parameters u_i.x u_i.y u_i.z u_j.x u_j.y u_j.z f_i.x f_i.y f_i.z g_i.x g_i.y g_i.z h_j.x h_j.y h_j.z
rows 218 223 228 233
- Parameter 0
- Parameter 1
- Parameter 2
- Parameter 3
- Parameter 4
- Parameter 5
- Parameter 6
- Parameter 7
- Parameter 8
- Parameter 9
- Parameter 10
- Parameter 11
- Parameter 12
- Parameter 13
- Parameter 14
0 Column 3
0 Column 4
0 Column 5
0 Column 6
0 Constant 2.0
0 Product 6 16
0 Product 7 17
0 Sum 20 21
0 Product 8 18
0 Sum 22 23
0 Product 6 15
0 Product 8 17
0 Product 7 18
0 Difference 25 27
0 Sum 26 28
0 Product 15 29
0 Product 16 24
0 Sum 30 31
0 Product 19 32
0 Difference 33 6
0 Product 7 15
0 Product 6 18
0 Product 8 16
0 Difference 35 37
0 Sum 36 38
0 Product 15 39
0 Product 17 24
0 Sum 40 41
0 Product 19 42
0 Difference 43 7
0 Product 8 15
0 Product 7 16
0 Product 6 17
0 Difference 45 47
0 Sum 46 48
0 Product 15 49
0 Product 18 24
0 Sum 50 51
0 Product 19 52
0 Difference 53 8
1 Product 9 16
1 Product 10 17
1 Sum 55 56
1 Product 11 18
1 Sum 57 58
1 Product 9 15
1 Product 11 17
1 Product 10 18
1 Difference 60 62
1 Sum 61 63
1 Product 15 64
1 Product 16 59
1 Sum 65 66
1 Product 19 67
1 Difference 68 9
1 Product 10 15
1 Product 9 18
1 Product 11 16
1 Difference 70 72
1 Sum 71 73
1 Product 15 74
1 Product 17 59
1 Sum 75 76
1 Product 19 77
1 Difference 78 10
1 Product 11 15
1 Product 10 16
1 Product 9 17
1 Difference 80 82
1 Sum 81 83
1 Product 15 84
1 Product 18 59
1 Sum 85 86
1 Product 19 87
1 Difference 88 11
2 Column 10
2 Column 11
2 Column 12
2 Column 13
2 Product 12 91
2 Product 13 92
2 Sum 94 95
2 Product 14 93
2 Sum 96 97
2 Product 12 90
2 Product 14 92
2 Product 13 93
2 Difference 99 101
2 Sum 100 102
2 Product 90 103
2 Product 91 98
2 Sum 104 105
2 Product 19 106
2 Difference 107 12
2 Product 13 90
2 Product 12 93
2 Product 14 91
2 Difference 109 111
2 Sum 110 112
2 Product 90 113
2 Product 92 98
2 Sum 114 115
2 Product 19 116
2 Difference 117 13
2 Product 14 90
2 Product 13 91
2 Product 12 92
2 Difference 119 121
2 Sum 120 122
2 Product 90 123
2 Product 93 98
2 Sum 124 125
2 Product 19 126
2 Difference 127 14
3 Column 0
3 Column 1
3 Column 2
3 Product 0 16
3 Product 1 17
3 Sum 132 133
3 Product 2 18
3 Sum 134 135
3 Product 0 15
3 Product 2 17
3 Product 1 18
3 Difference 137 139
3 Sum 138 140
3 Product 15 141
3 Product 16 136
3 Sum 142 143
3 Product 19 144
3 Difference 145 0
3 Product 1 15
3 Product 0 18
3 Product 2 16
3 Difference 147 149
3 Sum 148 150
3 Product 15 151
3 Product 17 136
3 Sum 152 153
3 Product 19 154
3 Difference 155 1
3 Product 2 15
3 Product 1 16
3 Product 0 17
3 Difference 157 159
3 Sum 158 160
3 Product 15 161
3 Product 18 136
3 Sum 162 163
3 Product 19 164
3 Difference 165 2
3 Sum 129 146
3 Sum 130 156
3 Sum 131 166
4 Column 7
4 Column 8
4 Column 9
4 Product 3 91
4 Product 4 92
4 Sum 173 174
4 Product 5 93
4 Sum 175 176
4 Product 3 90
4 Product 5 92
4 Product 4 93
4 Difference 178 180
4 Sum 179 181
4 Product 90 182
4 Product 91 177
4 Sum 183 184
4 Product 19 185
4 Difference 186 3
4 Product 4 90
4 Product 3 93
4 Product 5 91
4 Difference 188 190
4 Sum 189 191
4 Product 90 192
4 Product 92 177
4 Sum 193 194
4 Product 19 195
4 Difference 196 4
4 Product 5 90
4 Product 4 91
4 Product 3 92
4 Difference 198 200
4 Sum 199 201
4 Product 90 202
4 Product 93 177
4 Sum 203 204
4 Product 19 205
4 Difference 206 5
4 Sum 170 187
4 Sum 171 197
4 Sum 172 207
5 Difference 167 208
5 Difference 168 209
5 Difference 169 210
6 Product 34 108
6 Product 44 118
6 Sum 214 215
6 Product 54 128
6 Sum 216 217
7 Product 69 108
7 Product 79 118
7 Sum 219 220
7 Product 89 128
7 Sum 221 222
8 Product 34 211
8 Product 44 212
8 Sum 224 225
8 Product 54 213
8 Sum 226 227
9 Product 69 211
9 Product 79 212
9 Sum 229 230
9 Product 89 213
9 Sum 231 232"##,
            );
            TABLE
                .with(
                    &[
                        self.u_i.x,
                        self.u_i.y,
                        self.u_i.z,
                        self.u_j.x,
                        self.u_j.y,
                        self.u_j.z,
                        self.f_i.x,
                        self.f_i.y,
                        self.f_i.z,
                        self.g_i.x,
                        self.g_i.y,
                        self.g_i.z,
                        self.h_j.x,
                        self.h_j.y,
                        self.h_j.z,
                    ],
                )
        }
        fn attachments(&self) -> ::std::vec::Vec<::kin::emitted::Attachment> {
            ::kin::emitted::attachments(
                &[
                    ::kin::emitted::direction(0, [self.f_i.x, self.f_i.y, self.f_i.z]),
                    ::kin::emitted::direction(0, [self.g_i.x, self.g_i.y, self.g_i.z]),
                    ::kin::emitted::direction(1, [self.h_j.x, self.h_j.y, self.h_j.z]),
                    ::kin::emitted::point(0, [self.u_i.x, self.u_i.y, self.u_i.z]),
                    ::kin::emitted::point(1, [self.u_j.x, self.u_j.y, self.u_j.z]),
                ],
            )
        }
    }
    #[allow(unused, non_snake_case, clippy::all, clippy::pedantic, clippy::nursery)]
    impl ::kin::emitted::Described for cylindrical {
        const KIND: &'static str = "cylindrical";
        const ARGUMENTS: &'static [::kin::emitted::ArgumentKind] = <Self as ::kin::emitted::Equation<
            14,
            4,
        >>::ARGUMENTS;
        fn read(from: &mut ::kin::emitted::Reader<'_>) -> ::core::option::Option<Self> {
            use ::kin::emitted::{IncomingBySerde as _, IncomingRefused as _};
            ::core::option::Option::Some(cylindrical {
                i: from.spatial(),
                j: from.spatial(),
                u_i: from.get("u_i"),
                u_j: from.get("u_j"),
                f_i: from.get("f_i"),
                g_i: from.get("g_i"),
                h_j: from.get("h_j"),
                __bindings: ::kin::emitted::Bindings::NONE,
            })
        }
    }
    #[allow(unused, non_snake_case, clippy::all, clippy::pedantic, clippy::nursery)]
    impl ::kin::emitted::Equation<14, 4> for cylindrical {
        const ARGUMENTS: &'static [::kin::emitted::ArgumentKind] = &[
            ::kin::emitted::ArgumentKind::Spatial,
            ::kin::emitted::ArgumentKind::Spatial,
        ];
        fn evaluate<__D: ::kin::emitted::Dual>(
            &self,
            q: &[::kin::emitted::Real<__D>; 14],
            t: ::kin::emitted::Real<__D>,
        ) -> [::kin::emitted::Real<__D>; 4] {
            let mut q = ::kin::emitted::Columns(q);
            let i: ::kin::emitted::SpatialState<__Real<__D>> = q.spatial();
            let j: ::kin::emitted::SpatialState<__Real<__D>> = q.spatial();
            let u_i: ::kin::emitted::Vec3<__Real<__D>> = ::kin::emitted::Lift::lift(
                self.u_i,
            );
            let u_j: ::kin::emitted::Vec3<__Real<__D>> = ::kin::emitted::Lift::lift(
                self.u_j,
            );
            let f_i: ::kin::emitted::Vec3<__Real<__D>> = ::kin::emitted::Lift::lift(
                self.f_i,
            );
            let g_i: ::kin::emitted::Vec3<__Real<__D>> = ::kin::emitted::Lift::lift(
                self.g_i,
            );
            let h_j: ::kin::emitted::Vec3<__Real<__D>> = ::kin::emitted::Lift::lift(
                self.h_j,
            );
            let value = (move || -> (__Real<__D>, __Real<__D>, __Real<__D>, __Real<__D>) {
                let f = i.direction(f_i);
                let g = i.direction(g_i);
                let h = j.direction(h_j);
                let d = i.point(u_i) - j.point(u_j);
                (f.dot(h), g.dot(h), f.dot(d), g.dot(d))
            })();
            ::kin::emitted::rows(value)
        }
        #[inline]
        fn plain(&self, q: &[f64; 14], t: f64) -> [f64; 4] {
            let mut q = ::kin::emitted::Columns(q);
            ::kin::emitted::rows(
                __WRITTEN(
                    q.spatial(),
                    q.spatial(),
                    self.u_i,
                    self.u_j,
                    self.f_i,
                    self.g_i,
                    self.h_j,
                ),
            )
        }
    }
};
