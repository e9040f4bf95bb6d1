/// The constraint that [`fn@cylindrical`] makes.
///
/// A cylindrical joint: the axes are parallel and the line between two of their points is along them.      [–, –, m, m]
#[allow(non_camel_case_types)]
#[derive(Clone)]
pub struct cylindrical {
    i: ::kin::SpatialBody,
    j: ::kin::SpatialBody,
    u_i: Vec3,
    u_j: Vec3,
    f_i: Vec3,
    g_i: Vec3,
    h_j: Vec3,
}
/// A cylindrical joint: the axes are parallel and the line between two of their points is along them.      [–, –, m, m]
#[allow(clippy::too_many_arguments)]
#[must_use]
pub fn cylindrical(
    i: impl ::core::convert::Into<::kin::SpatialBody>,
    j: impl ::core::convert::Into<::kin::SpatialBody>,
    u_i: Vec3,
    u_j: Vec3,
    f_i: Vec3,
    g_i: Vec3,
    h_j: Vec3,
) -> cylindrical {
    cylindrical {
        i: ::core::convert::Into::into(i),
        j: ::core::convert::Into::into(j),
        u_i,
        u_j,
        f_i,
        g_i,
        h_j,
    }
}
#[allow(unused, clippy::all, clippy::pedantic, clippy::nursery)]
const _: () = {
    use ::kin::rt::{LiftAny as _, LiftNumbers as _, LowerAny as _, LowerReal as _};
    use ::kin::rt::{ReceiveAny as _, ReceiveNumbers as _, ReceiveReference as _};
    /// The function as it was written.
    const __WRITTEN: fn(
        ::kin::rt::SpatialState,
        ::kin::rt::SpatialState,
        Vec3,
        Vec3,
        Vec3,
        Vec3,
        Vec3,
    ) -> (f64, f64, f64, f64) = |i, j, u_i, u_j, f_i, g_i, h_j| {
        let (f, g, h) = (i.direction(f_i), i.direction(g_i), j.direction(h_j));
        let d = i.point(u_i) - j.point(u_j);
        (f.dot(h), g.dot(h), f.dot(d), g.dot(d))
    };
    const __SOUND: bool = {
        let _ = __WRITTEN;
        true
    };
    type __Dual<D> = ::kin::rt::If<__SOUND, D>;
    type __Real<D> = ::kin::rt::Real<__Dual<D>>;
    impl ::kin::Constraint for cylindrical {
        fn kind(&self) -> &str {
            "cylindrical"
        }
        fn route(&self) -> ::kin::Route {
            ::kin::Route::Symbolic
        }
        fn arguments(&self) -> ::std::vec::Vec<::kin::rt::Argument> {
            ::std::vec![
                ::kin::rt::Argument { name : "i", target :
                ::kin::rt::Target::Spatial(self.i) }, ::kin::rt::Argument { name : "j",
                target : ::kin::rt::Target::Spatial(self.j) }
            ]
        }
        fn rows(&self) -> &[&str] {
            &["1", "2", "3", "4"]
        }
        fn pattern(&self) -> &[(usize, usize)] {
            &[
                (0, 3),
                (0, 4),
                (0, 5),
                (0, 6),
                (0, 10),
                (0, 11),
                (0, 12),
                (0, 13),
                (1, 3),
                (1, 4),
                (1, 5),
                (1, 6),
                (1, 10),
                (1, 11),
                (1, 12),
                (1, 13),
                (2, 0),
                (2, 1),
                (2, 2),
                (2, 3),
                (2, 4),
                (2, 5),
                (2, 6),
                (2, 7),
                (2, 8),
                (2, 9),
                (2, 10),
                (2, 11),
                (2, 12),
                (2, 13),
                (3, 0),
                (3, 1),
                (3, 2),
                (3, 3),
                (3, 4),
                (3, 5),
                (3, 6),
                (3, 7),
                (3, 8),
                (3, 9),
                (3, 10),
                (3, 11),
                (3, 12),
                (3, 13),
            ]
        }
        fn describe(&self, to: &mut ::kin::rt::Describer) {
            use ::kin::rt::{ToldBySerde as _, Untold as _};
            to.put("u_i", &self.u_i);
            to.put("u_j", &self.u_j);
            to.put("f_i", &self.f_i);
            to.put("g_i", &self.g_i);
            to.put("h_j", &self.h_j);
        }
        fn depends(&self) -> ::kin::Dependence {
            ::kin::Dependence {
                c_on_t: false,
                c_q_on_t: false,
                c_t: false,
                q_d: true,
            }
        }
        /// C: 104 operations
        fn residual(&self, at: &::kin::rt::At<'_>, c: &mut [f64]) {
            let ::core::option::Option::Some(c) = c.first_chunk_mut::<4>() else {
                return
            };
            let ::core::option::Option::Some(
                &[i_x,
                i_y,
                i_z,
                _,
                _,
                _,
                _,
                i_a11,
                i_a12,
                i_a13,
                i_a21,
                i_a22,
                i_a23,
                i_a31,
                i_a32,
                i_a33,
                j_x,
                j_y,
                j_z,
                _,
                _,
                _,
                _,
                j_a11,
                j_a12,
                j_a13,
                j_a21,
                j_a22,
                j_a23,
                j_a31,
                j_a32,
                j_a33,
                ],
            ) = at.states::<32>() else { return };
            let t0 = ((self.f_i.x * i_a11) + (self.f_i.y * i_a12))
                + (self.f_i.z * i_a13);
            let t1 = ((self.f_i.x * i_a21) + (self.f_i.y * i_a22))
                + (self.f_i.z * i_a23);
            let t2 = ((self.f_i.x * i_a31) + (self.f_i.y * i_a32))
                + (self.f_i.z * i_a33);
            let t3 = ((self.g_i.x * i_a11) + (self.g_i.y * i_a12))
                + (self.g_i.z * i_a13);
            let t4 = ((self.g_i.x * i_a21) + (self.g_i.y * i_a22))
                + (self.g_i.z * i_a23);
            let t5 = ((self.g_i.x * i_a31) + (self.g_i.y * i_a32))
                + (self.g_i.z * i_a33);
            let t6 = ((self.h_j.x * j_a11) + (self.h_j.y * j_a12))
                + (self.h_j.z * j_a13);
            let t7 = ((self.h_j.x * j_a21) + (self.h_j.y * j_a22))
                + (self.h_j.z * j_a23);
            let t8 = ((self.h_j.x * j_a31) + (self.h_j.y * j_a32))
                + (self.h_j.z * j_a33);
            let t9 = (i_x
                + (((self.u_i.x * i_a11) + (self.u_i.y * i_a12)) + (self.u_i.z * i_a13)))
                - (j_x
                    + (((self.u_j.x * j_a11) + (self.u_j.y * j_a12))
                        + (self.u_j.z * j_a13)));
            let t10 = (i_y
                + (((self.u_i.x * i_a21) + (self.u_i.y * i_a22)) + (self.u_i.z * i_a23)))
                - (j_y
                    + (((self.u_j.x * j_a21) + (self.u_j.y * j_a22))
                        + (self.u_j.z * j_a23)));
            let t11 = (i_z
                + (((self.u_i.x * i_a31) + (self.u_i.y * i_a32)) + (self.u_i.z * i_a33)))
                - (j_z
                    + (((self.u_j.x * j_a31) + (self.u_j.y * j_a32))
                        + (self.u_j.z * j_a33)));
            c[0] = ((t0 * t6) + (t1 * t7)) + (t2 * t8);
            c[1] = ((t3 * t6) + (t4 * t7)) + (t5 * t8);
            c[2] = ((t0 * t9) + (t1 * t10)) + (t2 * t11);
            c[3] = ((t3 * t9) + (t4 * t10)) + (t5 * t11);
        }
        /// C_q: 518 operations
        #[inline]
        fn jacobian(&self, at: &::kin::rt::At<'_>, c_q: &mut [f64]) {
            let ::core::option::Option::Some(c_q) = c_q.first_chunk_mut::<44>() else {
                return
            };
            let ::core::option::Option::Some(
                &[i_x,
                i_y,
                i_z,
                i_e0,
                i_e1,
                i_e2,
                i_e3,
                i_a11,
                i_a12,
                i_a13,
                i_a21,
                i_a22,
                i_a23,
                i_a31,
                i_a32,
                i_a33,
                j_x,
                j_y,
                j_z,
                j_e0,
                j_e1,
                j_e2,
                j_e3,
                j_a11,
                j_a12,
                j_a13,
                j_a21,
                j_a22,
                j_a23,
                j_a31,
                j_a32,
                j_a33,
                ],
            ) = at.states::<32>() else { return };
            let t0 = ((self.f_i.x * i_a11) + (self.f_i.y * i_a12))
                + (self.f_i.z * i_a13);
            let t1 = ((self.f_i.x * i_a21) + (self.f_i.y * i_a22))
                + (self.f_i.z * i_a23);
            let t2 = ((self.f_i.x * i_a31) + (self.f_i.y * i_a32))
                + (self.f_i.z * i_a33);
            let t3 = ((self.g_i.x * i_a11) + (self.g_i.y * i_a12))
                + (self.g_i.z * i_a13);
            let t4 = ((self.g_i.x * i_a21) + (self.g_i.y * i_a22))
                + (self.g_i.z * i_a23);
            let t5 = ((self.g_i.x * i_a31) + (self.g_i.y * i_a32))
                + (self.g_i.z * i_a33);
            let t6 = ((self.h_j.x * j_a11) + (self.h_j.y * j_a12))
                + (self.h_j.z * j_a13);
            let t7 = ((self.h_j.x * j_a21) + (self.h_j.y * j_a22))
                + (self.h_j.z * j_a23);
            let t8 = ((self.h_j.x * j_a31) + (self.h_j.y * j_a32))
                + (self.h_j.z * j_a33);
            let t9 = (i_x
                + (((self.u_i.x * i_a11) + (self.u_i.y * i_a12)) + (self.u_i.z * i_a13)))
                - (j_x
                    + (((self.u_j.x * j_a11) + (self.u_j.y * j_a12))
                        + (self.u_j.z * j_a13)));
            let t10 = (i_y
                + (((self.u_i.x * i_a21) + (self.u_i.y * i_a22)) + (self.u_i.z * i_a23)))
                - (j_y
                    + (((self.u_j.x * j_a21) + (self.u_j.y * j_a22))
                        + (self.u_j.z * j_a23)));
            let t11 = (i_z
                + (((self.u_i.x * i_a31) + (self.u_i.y * i_a32)) + (self.u_i.z * i_a33)))
                - (j_z
                    + (((self.u_j.x * j_a31) + (self.u_j.y * j_a32))
                        + (self.u_j.z * j_a33)));
            let t12 = self.f_i.x * i_e0;
            let t13 = self.f_i.y * i_e3;
            let t14 = self.f_i.z * i_e2;
            let t15 = ((2.0 * t12) - t13) + t14;
            let t16 = self.f_i.x * i_e3;
            let t17 = self.f_i.y * i_e0;
            let t18 = self.f_i.z * i_e1;
            let t19 = (t16 + (2.0 * t17)) - t18;
            let t20 = self.f_i.x * i_e2;
            let t21 = self.f_i.y * i_e1;
            let t22 = self.f_i.z * i_e0;
            let t23 = (t21 - t20) + (2.0 * t22);
            let t24 = self.f_i.x * i_e1;
            let t25 = self.f_i.y * i_e2;
            let t26 = self.f_i.z * i_e3;
            let t27 = (t25 + (2.0 * t24)) + t26;
            let t28 = t20 - t22;
            let t29 = t16 + t17;
            let t30 = t21 + t22;
            let t31 = t26 + (t24 + (2.0 * t25));
            let t32 = t13 - t12;
            let t33 = t18 - t17;
            let t34 = t12 + t14;
            let t35 = (2.0 * t26) + (t24 + t25);
            let t36 = self.h_j.x * j_e0;
            let t37 = self.h_j.y * j_e3;
            let t38 = self.h_j.z * j_e2;
            let t39 = ((2.0 * t36) - t37) + t38;
            let t40 = self.h_j.x * j_e3;
            let t41 = self.h_j.y * j_e0;
            let t42 = self.h_j.z * j_e1;
            let t43 = (t40 + (2.0 * t41)) - t42;
            let t44 = self.h_j.x * j_e2;
            let t45 = self.h_j.y * j_e1;
            let t46 = self.h_j.z * j_e0;
            let t47 = (t45 - t44) + (2.0 * t46);
            let t48 = self.h_j.x * j_e1;
            let t49 = self.h_j.y * j_e2;
            let t50 = self.h_j.z * j_e3;
            let t51 = (t49 + (2.0 * t48)) + t50;
            let t52 = t44 - t46;
            let t53 = t40 + t41;
            let t54 = t45 + t46;
            let t55 = t50 + (t48 + (2.0 * t49));
            let t56 = t37 - t36;
            let t57 = t42 - t41;
            let t58 = t36 + t38;
            let t59 = (2.0 * t50) + (t48 + t49);
            let t60 = self.g_i.x * i_e0;
            let t61 = self.g_i.y * i_e3;
            let t62 = self.g_i.z * i_e2;
            let t63 = ((2.0 * t60) - t61) + t62;
            let t64 = self.g_i.x * i_e3;
            let t65 = self.g_i.y * i_e0;
            let t66 = self.g_i.z * i_e1;
            let t67 = (t64 + (2.0 * t65)) - t66;
            let t68 = self.g_i.x * i_e2;
            let t69 = self.g_i.y * i_e1;
            let t70 = self.g_i.z * i_e0;
            let t71 = (t69 - t68) + (2.0 * t70);
            let t72 = self.g_i.x * i_e1;
            let t73 = self.g_i.y * i_e2;
            let t74 = self.g_i.z * i_e3;
            let t75 = (t73 + (2.0 * t72)) + t74;
            let t76 = t68 - t70;
            let t77 = t64 + t65;
            let t78 = t69 + t70;
            let t79 = t74 + (t72 + (2.0 * t73));
            let t80 = t61 - t60;
            let t81 = t66 - t65;
            let t82 = t60 + t62;
            let t83 = (2.0 * t74) + (t72 + t73);
            let t84 = self.u_i.x * i_e0;
            let t85 = self.u_i.y * i_e3;
            let t86 = self.u_i.z * i_e2;
            let t87 = ((2.0 * t84) - t85) + t86;
            let t88 = self.u_i.x * i_e3;
            let t89 = self.u_i.y * i_e0;
            let t90 = self.u_i.z * i_e1;
            let t91 = (t88 + (2.0 * t89)) - t90;
            let t92 = self.u_i.x * i_e2;
            let t93 = self.u_i.y * i_e1;
            let t94 = self.u_i.z * i_e0;
            let t95 = (t93 - t92) + (2.0 * t94);
            let t96 = self.u_i.x * i_e1;
            let t97 = self.u_i.y * i_e2;
            let t98 = self.u_i.z * i_e3;
            let t99 = (t97 + (2.0 * t96)) + t98;
            let t100 = t92 - t94;
            let t101 = t88 + t89;
            let t102 = t93 + t94;
            let t103 = t98 + (t96 + (2.0 * t97));
            let t104 = t85 - t84;
            let t105 = t90 - t89;
            let t106 = t84 + t86;
            let t107 = (2.0 * t98) + (t96 + t97);
            let t108 = self.u_j.x * j_e0;
            let t109 = self.u_j.y * j_e3;
            let t110 = self.u_j.z * j_e2;
            let t111 = ((2.0 * t108) - t109) + t110;
            let t112 = self.u_j.x * j_e3;
            let t113 = self.u_j.y * j_e0;
            let t114 = self.u_j.z * j_e1;
            let t115 = (t112 + (2.0 * t113)) - t114;
            let t116 = self.u_j.x * j_e2;
            let t117 = self.u_j.y * j_e1;
            let t118 = self.u_j.z * j_e0;
            let t119 = (t117 - t116) + (2.0 * t118);
            let t120 = self.u_j.x * j_e1;
            let t121 = self.u_j.y * j_e2;
            let t122 = self.u_j.z * j_e3;
            let t123 = (t121 + (2.0 * t120)) + t122;
            let t124 = t116 - t118;
            let t125 = t112 + t113;
            let t126 = t117 + t118;
            let t127 = t122 + (t120 + (2.0 * t121));
            let t128 = t109 - t108;
            let t129 = t114 - t113;
            let t130 = t108 + t110;
            let t131 = (2.0 * t122) + (t120 + t121);
            c_q[0] = 2.0 * (((t6 * t15) + (t7 * t19)) + (t8 * t23));
            c_q[1] = 2.0 * (((t6 * t27) + (t7 * t28)) + (t8 * t29));
            c_q[2] = 2.0 * (((t6 * t30) + (t7 * t31)) + (t8 * t32));
            c_q[3] = 2.0 * (((t6 * t33) + (t7 * t34)) + (t8 * t35));
            c_q[4] = 2.0 * (((t0 * t39) + (t1 * t43)) + (t2 * t47));
            c_q[5] = 2.0 * (((t0 * t51) + (t1 * t52)) + (t2 * t53));
            c_q[6] = 2.0 * (((t0 * t54) + (t1 * t55)) + (t2 * t56));
            c_q[7] = 2.0 * (((t0 * t57) + (t1 * t58)) + (t2 * t59));
            c_q[8] = 2.0 * (((t6 * t63) + (t7 * t67)) + (t8 * t71));
            c_q[9] = 2.0 * (((t6 * t75) + (t7 * t76)) + (t8 * t77));
            c_q[10] = 2.0 * (((t6 * t78) + (t7 * t79)) + (t8 * t80));
            c_q[11] = 2.0 * (((t6 * t81) + (t7 * t82)) + (t8 * t83));
            c_q[12] = 2.0 * (((t3 * t39) + (t4 * t43)) + (t5 * t47));
            c_q[13] = 2.0 * (((t3 * t51) + (t4 * t52)) + (t5 * t53));
            c_q[14] = 2.0 * (((t3 * t54) + (t4 * t55)) + (t5 * t56));
            c_q[15] = 2.0 * (((t3 * t57) + (t4 * t58)) + (t5 * t59));
            c_q[16] = t0;
            c_q[17] = t1;
            c_q[18] = t2;
            c_q[19] = 2.0
                * ((((t9 * t15) + (t0 * t87)) + ((t10 * t19) + (t1 * t91)))
                    + ((t11 * t23) + (t2 * t95)));
            c_q[20] = 2.0
                * ((((t9 * t27) + (t0 * t99)) + ((t10 * t28) + (t1 * t100)))
                    + ((t11 * t29) + (t2 * t101)));
            c_q[21] = 2.0
                * ((((t9 * t30) + (t0 * t102)) + ((t10 * t31) + (t1 * t103)))
                    + ((t11 * t32) + (t2 * t104)));
            c_q[22] = 2.0
                * ((((t9 * t33) + (t0 * t105)) + ((t10 * t34) + (t1 * t106)))
                    + ((t11 * t35) + (t2 * t107)));
            c_q[23] = -t0;
            c_q[24] = -t1;
            c_q[25] = -t2;
            c_q[26] = -(2.0 * (((t0 * t111) + (t1 * t115)) + (t2 * t119)));
            c_q[27] = -(2.0 * (((t0 * t123) + (t1 * t124)) + (t2 * t125)));
            c_q[28] = -(2.0 * (((t0 * t126) + (t1 * t127)) + (t2 * t128)));
            c_q[29] = -(2.0 * (((t0 * t129) + (t1 * t130)) + (t2 * t131)));
            c_q[30] = t3;
            c_q[31] = t4;
            c_q[32] = t5;
            c_q[33] = 2.0
                * ((((t9 * t63) + (t3 * t87)) + ((t10 * t67) + (t4 * t91)))
                    + ((t11 * t71) + (t5 * t95)));
            c_q[34] = 2.0
                * ((((t9 * t75) + (t3 * t99)) + ((t10 * t76) + (t4 * t100)))
                    + ((t11 * t77) + (t5 * t101)));
            c_q[35] = 2.0
                * ((((t9 * t78) + (t3 * t102)) + ((t10 * t79) + (t4 * t103)))
                    + ((t11 * t80) + (t5 * t104)));
            c_q[36] = 2.0
                * ((((t9 * t81) + (t3 * t105)) + ((t10 * t82) + (t4 * t106)))
                    + ((t11 * t83) + (t5 * t107)));
            c_q[37] = -t3;
            c_q[38] = -t4;
            c_q[39] = -t5;
            c_q[40] = -(2.0 * (((t3 * t111) + (t4 * t115)) + (t5 * t119)));
            c_q[41] = -(2.0 * (((t3 * t123) + (t4 * t124)) + (t5 * t125)));
            c_q[42] = -(2.0 * (((t3 * t126) + (t4 * t127)) + (t5 * t128)));
            c_q[43] = -(2.0 * (((t3 * t129) + (t4 * t130)) + (t5 * t131)));
        }
        /// C and C_q: 538 operations
        fn linearize(&self, at: &::kin::rt::At<'_>, c: &mut [f64], c_q: &mut [f64]) {
            let ::core::option::Option::Some(c) = c.first_chunk_mut::<4>() else {
                return
            };
            let ::core::option::Option::Some(c_q) = c_q.first_chunk_mut::<44>() else {
                return
            };
            let ::core::option::Option::Some(
                &[i_x,
                i_y,
                i_z,
                i_e0,
                i_e1,
                i_e2,
                i_e3,
                i_a11,
                i_a12,
                i_a13,
                i_a21,
                i_a22,
                i_a23,
                i_a31,
                i_a32,
                i_a33,
                j_x,
                j_y,
                j_z,
                j_e0,
                j_e1,
                j_e2,
                j_e3,
                j_a11,
                j_a12,
                j_a13,
                j_a21,
                j_a22,
                j_a23,
                j_a31,
                j_a32,
                j_a33,
                ],
            ) = at.states::<32>() else { return };
            let t0 = ((self.f_i.x * i_a11) + (self.f_i.y * i_a12))
                + (self.f_i.z * i_a13);
            let t1 = ((self.f_i.x * i_a21) + (self.f_i.y * i_a22))
                + (self.f_i.z * i_a23);
            let t2 = ((self.f_i.x * i_a31) + (self.f_i.y * i_a32))
                + (self.f_i.z * i_a33);
            let t3 = ((self.g_i.x * i_a11) + (self.g_i.y * i_a12))
                + (self.g_i.z * i_a13);
            let t4 = ((self.g_i.x * i_a21) + (self.g_i.y * i_a22))
                + (self.g_i.z * i_a23);
            let t5 = ((self.g_i.x * i_a31) + (self.g_i.y * i_a32))
                + (self.g_i.z * i_a33);
            let t6 = ((self.h_j.x * j_a11) + (self.h_j.y * j_a12))
                + (self.h_j.z * j_a13);
            let t7 = ((self.h_j.x * j_a21) + (self.h_j.y * j_a22))
                + (self.h_j.z * j_a23);
            let t8 = ((self.h_j.x * j_a31) + (self.h_j.y * j_a32))
                + (self.h_j.z * j_a33);
            let t9 = (i_x
                + (((self.u_i.x * i_a11) + (self.u_i.y * i_a12)) + (self.u_i.z * i_a13)))
                - (j_x
                    + (((self.u_j.x * j_a11) + (self.u_j.y * j_a12))
                        + (self.u_j.z * j_a13)));
            let t10 = (i_y
                + (((self.u_i.x * i_a21) + (self.u_i.y * i_a22)) + (self.u_i.z * i_a23)))
                - (j_y
                    + (((self.u_j.x * j_a21) + (self.u_j.y * j_a22))
                        + (self.u_j.z * j_a23)));
            let t11 = (i_z
                + (((self.u_i.x * i_a31) + (self.u_i.y * i_a32)) + (self.u_i.z * i_a33)))
                - (j_z
                    + (((self.u_j.x * j_a31) + (self.u_j.y * j_a32))
                        + (self.u_j.z * j_a33)));
            let t12 = self.f_i.x * i_e0;
            let t13 = self.f_i.y * i_e3;
            let t14 = self.f_i.z * i_e2;
            let t15 = ((2.0 * t12) - t13) + t14;
            let t16 = self.f_i.x * i_e3;
            let t17 = self.f_i.y * i_e0;
            let t18 = self.f_i.z * i_e1;
            let t19 = (t16 + (2.0 * t17)) - t18;
            let t20 = self.f_i.x * i_e2;
            let t21 = self.f_i.y * i_e1;
            let t22 = self.f_i.z * i_e0;
            let t23 = (t21 - t20) + (2.0 * t22);
            let t24 = self.f_i.x * i_e1;
            let t25 = self.f_i.y * i_e2;
            let t26 = self.f_i.z * i_e3;
            let t27 = (t25 + (2.0 * t24)) + t26;
            let t28 = t20 - t22;
            let t29 = t16 + t17;
            let t30 = t21 + t22;
            let t31 = t26 + (t24 + (2.0 * t25));
            let t32 = t13 - t12;
            let t33 = t18 - t17;
            let t34 = t12 + t14;
            let t35 = (2.0 * t26) + (t24 + t25);
            let t36 = self.h_j.x * j_e0;
            let t37 = self.h_j.y * j_e3;
            let t38 = self.h_j.z * j_e2;
            let t39 = ((2.0 * t36) - t37) + t38;
            let t40 = self.h_j.x * j_e3;
            let t41 = self.h_j.y * j_e0;
            let t42 = self.h_j.z * j_e1;
            let t43 = (t40 + (2.0 * t41)) - t42;
            let t44 = self.h_j.x * j_e2;
            let t45 = self.h_j.y * j_e1;
            let t46 = self.h_j.z * j_e0;
            let t47 = (t45 - t44) + (2.0 * t46);
            let t48 = self.h_j.x * j_e1;
            let t49 = self.h_j.y * j_e2;
            let t50 = self.h_j.z * j_e3;
            let t51 = (t49 + (2.0 * t48)) + t50;
            let t52 = t44 - t46;
            let t53 = t40 + t41;
            let t54 = t45 + t46;
            let t55 = t50 + (t48 + (2.0 * t49));
            let t56 = t37 - t36;
            let t57 = t42 - t41;
            let t58 = t36 + t38;
            let t59 = (2.0 * t50) + (t48 + t49);
            let t60 = self.g_i.x * i_e0;
            let t61 = self.g_i.y * i_e3;
            let t62 = self.g_i.z * i_e2;
            let t63 = ((2.0 * t60) - t61) + t62;
            let t64 = self.g_i.x * i_e3;
            let t65 = self.g_i.y * i_e0;
            let t66 = self.g_i.z * i_e1;
            let t67 = (t64 + (2.0 * t65)) - t66;
            let t68 = self.g_i.x * i_e2;
            let t69 = self.g_i.y * i_e1;
            let t70 = self.g_i.z * i_e0;
            let t71 = (t69 - t68) + (2.0 * t70);
            let t72 = self.g_i.x * i_e1;
            let t73 = self.g_i.y * i_e2;
            let t74 = self.g_i.z * i_e3;
            let t75 = (t73 + (2.0 * t72)) + t74;
            let t76 = t68 - t70;
            let t77 = t64 + t65;
            let t78 = t69 + t70;
            let t79 = t74 + (t72 + (2.0 * t73));
            let t80 = t61 - t60;
            let t81 = t66 - t65;
            let t82 = t60 + t62;
            let t83 = (2.0 * t74) + (t72 + t73);
            let t84 = self.u_i.x * i_e0;
            let t85 = self.u_i.y * i_e3;
            let t86 = self.u_i.z * i_e2;
            let t87 = ((2.0 * t84) - t85) + t86;
            let t88 = self.u_i.x * i_e3;
            let t89 = self.u_i.y * i_e0;
            let t90 = self.u_i.z * i_e1;
            let t91 = (t88 + (2.0 * t89)) - t90;
            let t92 = self.u_i.x * i_e2;
            let t93 = self.u_i.y * i_e1;
            let t94 = self.u_i.z * i_e0;
            let t95 = (t93 - t92) + (2.0 * t94);
            let t96 = self.u_i.x * i_e1;
            let t97 = self.u_i.y * i_e2;
            let t98 = self.u_i.z * i_e3;
            let t99 = (t97 + (2.0 * t96)) + t98;
            let t100 = t92 - t94;
            let t101 = t88 + t89;
            let t102 = t93 + t94;
            let t103 = t98 + (t96 + (2.0 * t97));
            let t104 = t85 - t84;
            let t105 = t90 - t89;
            let t106 = t84 + t86;
            let t107 = (2.0 * t98) + (t96 + t97);
            let t108 = self.u_j.x * j_e0;
            let t109 = self.u_j.y * j_e3;
            let t110 = self.u_j.z * j_e2;
            let t111 = ((2.0 * t108) - t109) + t110;
            let t112 = self.u_j.x * j_e3;
            let t113 = self.u_j.y * j_e0;
            let t114 = self.u_j.z * j_e1;
            let t115 = (t112 + (2.0 * t113)) - t114;
            let t116 = self.u_j.x * j_e2;
            let t117 = self.u_j.y * j_e1;
            let t118 = self.u_j.z * j_e0;
            let t119 = (t117 - t116) + (2.0 * t118);
            let t120 = self.u_j.x * j_e1;
            let t121 = self.u_j.y * j_e2;
            let t122 = self.u_j.z * j_e3;
            let t123 = (t121 + (2.0 * t120)) + t122;
            let t124 = t116 - t118;
            let t125 = t112 + t113;
            let t126 = t117 + t118;
            let t127 = t122 + (t120 + (2.0 * t121));
            let t128 = t109 - t108;
            let t129 = t114 - t113;
            let t130 = t108 + t110;
            let t131 = (2.0 * t122) + (t120 + t121);
            c[0] = ((t0 * t6) + (t1 * t7)) + (t2 * t8);
            c[1] = ((t3 * t6) + (t4 * t7)) + (t5 * t8);
            c[2] = ((t0 * t9) + (t1 * t10)) + (t2 * t11);
            c[3] = ((t3 * t9) + (t4 * t10)) + (t5 * t11);
            c_q[0] = 2.0 * (((t6 * t15) + (t7 * t19)) + (t8 * t23));
            c_q[1] = 2.0 * (((t6 * t27) + (t7 * t28)) + (t8 * t29));
            c_q[2] = 2.0 * (((t6 * t30) + (t7 * t31)) + (t8 * t32));
            c_q[3] = 2.0 * (((t6 * t33) + (t7 * t34)) + (t8 * t35));
            c_q[4] = 2.0 * (((t0 * t39) + (t1 * t43)) + (t2 * t47));
            c_q[5] = 2.0 * (((t0 * t51) + (t1 * t52)) + (t2 * t53));
            c_q[6] = 2.0 * (((t0 * t54) + (t1 * t55)) + (t2 * t56));
            c_q[7] = 2.0 * (((t0 * t57) + (t1 * t58)) + (t2 * t59));
            c_q[8] = 2.0 * (((t6 * t63) + (t7 * t67)) + (t8 * t71));
            c_q[9] = 2.0 * (((t6 * t75) + (t7 * t76)) + (t8 * t77));
            c_q[10] = 2.0 * (((t6 * t78) + (t7 * t79)) + (t8 * t80));
            c_q[11] = 2.0 * (((t6 * t81) + (t7 * t82)) + (t8 * t83));
            c_q[12] = 2.0 * (((t3 * t39) + (t4 * t43)) + (t5 * t47));
            c_q[13] = 2.0 * (((t3 * t51) + (t4 * t52)) + (t5 * t53));
            c_q[14] = 2.0 * (((t3 * t54) + (t4 * t55)) + (t5 * t56));
            c_q[15] = 2.0 * (((t3 * t57) + (t4 * t58)) + (t5 * t59));
            c_q[16] = t0;
            c_q[17] = t1;
            c_q[18] = t2;
            c_q[19] = 2.0
                * ((((t9 * t15) + (t0 * t87)) + ((t10 * t19) + (t1 * t91)))
                    + ((t11 * t23) + (t2 * t95)));
            c_q[20] = 2.0
                * ((((t9 * t27) + (t0 * t99)) + ((t10 * t28) + (t1 * t100)))
                    + ((t11 * t29) + (t2 * t101)));
            c_q[21] = 2.0
                * ((((t9 * t30) + (t0 * t102)) + ((t10 * t31) + (t1 * t103)))
                    + ((t11 * t32) + (t2 * t104)));
            c_q[22] = 2.0
                * ((((t9 * t33) + (t0 * t105)) + ((t10 * t34) + (t1 * t106)))
                    + ((t11 * t35) + (t2 * t107)));
            c_q[23] = -t0;
            c_q[24] = -t1;
            c_q[25] = -t2;
            c_q[26] = -(2.0 * (((t0 * t111) + (t1 * t115)) + (t2 * t119)));
            c_q[27] = -(2.0 * (((t0 * t123) + (t1 * t124)) + (t2 * t125)));
            c_q[28] = -(2.0 * (((t0 * t126) + (t1 * t127)) + (t2 * t128)));
            c_q[29] = -(2.0 * (((t0 * t129) + (t1 * t130)) + (t2 * t131)));
            c_q[30] = t3;
            c_q[31] = t4;
            c_q[32] = t5;
            c_q[33] = 2.0
                * ((((t9 * t63) + (t3 * t87)) + ((t10 * t67) + (t4 * t91)))
                    + ((t11 * t71) + (t5 * t95)));
            c_q[34] = 2.0
                * ((((t9 * t75) + (t3 * t99)) + ((t10 * t76) + (t4 * t100)))
                    + ((t11 * t77) + (t5 * t101)));
            c_q[35] = 2.0
                * ((((t9 * t78) + (t3 * t102)) + ((t10 * t79) + (t4 * t103)))
                    + ((t11 * t80) + (t5 * t104)));
            c_q[36] = 2.0
                * ((((t9 * t81) + (t3 * t105)) + ((t10 * t82) + (t4 * t106)))
                    + ((t11 * t83) + (t5 * t107)));
            c_q[37] = -t3;
            c_q[38] = -t4;
            c_q[39] = -t5;
            c_q[40] = -(2.0 * (((t3 * t111) + (t4 * t115)) + (t5 * t119)));
            c_q[41] = -(2.0 * (((t3 * t123) + (t4 * t124)) + (t5 * t125)));
            c_q[42] = -(2.0 * (((t3 * t126) + (t4 * t127)) + (t5 * t128)));
            c_q[43] = -(2.0 * (((t3 * t129) + (t4 * t130)) + (t5 * t131)));
        }
        fn velocity_rhs(&self, _at: &::kin::rt::At<'_>, rhs: &mut [f64]) {
            rhs.iter_mut().take(4).for_each(|value| *value = 0.0);
        }
        /// Q_d for t_dot = 1: 449 operations
        fn acceleration_rhs(
            &self,
            at: &::kin::rt::At<'_>,
            qd: &::kin::rt::Rates<'_>,
            t_dot: f64,
            q_d: &mut [f64],
        ) {
            let ::core::option::Option::Some(q_d) = q_d.first_chunk_mut::<4>() else {
                return
            };
            let ::core::option::Option::Some(
                &[i_x,
                i_y,
                i_z,
                i_e0,
                i_e1,
                i_e2,
                i_e3,
                i_a11,
                i_a12,
                i_a13,
                i_a21,
                i_a22,
                i_a23,
                i_a31,
                i_a32,
                i_a33,
                j_x,
                j_y,
                j_z,
                j_e0,
                j_e1,
                j_e2,
                j_e3,
                j_a11,
                j_a12,
                j_a13,
                j_a21,
                j_a22,
                j_a23,
                j_a31,
                j_a32,
                j_a33,
                ],
            ) = at.states::<32>() else { return };
            let ::core::option::Option::Some(
                &[i_x_d,
                i_y_d,
                i_z_d,
                i_e0_d,
                i_e1_d,
                i_e2_d,
                i_e3_d,
                j_x_d,
                j_y_d,
                j_z_d,
                j_e0_d,
                j_e1_d,
                j_e2_d,
                j_e3_d,
                ],
            ) = qd.columns::<14>() else { return };
            let t0 = ((self.f_i.x * i_a11) + (self.f_i.y * i_a12))
                + (self.f_i.z * i_a13);
            let t1 = ((self.f_i.x * i_a21) + (self.f_i.y * i_a22))
                + (self.f_i.z * i_a23);
            let t2 = ((self.f_i.x * i_a31) + (self.f_i.y * i_a32))
                + (self.f_i.z * i_a33);
            let t3 = ((self.g_i.x * i_a11) + (self.g_i.y * i_a12))
                + (self.g_i.z * i_a13);
            let t4 = ((self.g_i.x * i_a21) + (self.g_i.y * i_a22))
                + (self.g_i.z * i_a23);
            let t5 = ((self.g_i.x * i_a31) + (self.g_i.y * i_a32))
                + (self.g_i.z * i_a33);
            let t6 = ((self.h_j.x * j_a11) + (self.h_j.y * j_a12))
                + (self.h_j.z * j_a13);
            let t7 = ((self.h_j.x * j_a21) + (self.h_j.y * j_a22))
                + (self.h_j.z * j_a23);
            let t8 = ((self.h_j.x * j_a31) + (self.h_j.y * j_a32))
                + (self.h_j.z * j_a33);
            let t9 = (i_x
                + (((self.u_i.x * i_a11) + (self.u_i.y * i_a12)) + (self.u_i.z * i_a13)))
                - (j_x
                    + (((self.u_j.x * j_a11) + (self.u_j.y * j_a12))
                        + (self.u_j.z * j_a13)));
            let t10 = (i_y
                + (((self.u_i.x * i_a21) + (self.u_i.y * i_a22)) + (self.u_i.z * i_a23)))
                - (j_y
                    + (((self.u_j.x * j_a21) + (self.u_j.y * j_a22))
                        + (self.u_j.z * j_a23)));
            let t11 = (i_z
                + (((self.u_i.x * i_a31) + (self.u_i.y * i_a32)) + (self.u_i.z * i_a33)))
                - (j_z
                    + (((self.u_j.x * j_a31) + (self.u_j.y * j_a32))
                        + (self.u_j.z * j_a33)));
            let t12 = i_e0 * i_e0_d;
            let t13 = i_e0_d * i_e0_d;
            let t14 = t12 + (i_e1 * i_e1_d);
            let t15 = t13 + (i_e1_d * i_e1_d);
            let t16 = (i_e2 * i_e1_d) + (i_e1 * i_e2_d);
            let t17 = i_e1_d * i_e2_d;
            let t18 = (i_e3 * i_e0_d) + (i_e0 * i_e3_d);
            let t19 = i_e0_d * i_e3_d;
            let t20 = t16 - t18;
            let t21 = t17 - t19;
            let t22 = (i_e3 * i_e1_d) + (i_e1 * i_e3_d);
            let t23 = i_e1_d * i_e3_d;
            let t24 = (i_e2 * i_e0_d) + (i_e0 * i_e2_d);
            let t25 = i_e0_d * i_e2_d;
            let t26 = t22 + t24;
            let t27 = t23 + t25;
            let t28 = t16 + t18;
            let t29 = t17 + t19;
            let t30 = t12 + (i_e2 * i_e2_d);
            let t31 = t13 + (i_e2_d * i_e2_d);
            let t32 = (i_e3 * i_e2_d) + (i_e2 * i_e3_d);
            let t33 = i_e2_d * i_e3_d;
            let t34 = (i_e1 * i_e0_d) + (i_e0 * i_e1_d);
            let t35 = i_e0_d * i_e1_d;
            let t36 = t32 - t34;
            let t37 = t33 - t35;
            let t38 = t22 - t24;
            let t39 = t23 - t25;
            let t40 = t32 + t34;
            let t41 = t33 + t35;
            let t42 = t12 + (i_e3 * i_e3_d);
            let t43 = t13 + (i_e3_d * i_e3_d);
            let t44 = ((self.f_i.y * t20) + (2.0 * (self.f_i.x * t14)))
                + (self.f_i.z * t26);
            let t45 = ((self.f_i.x * t28) + (2.0 * (self.f_i.y * t30)))
                + (self.f_i.z * t36);
            let t46 = ((self.f_i.x * t38) + (self.f_i.y * t40))
                + (2.0 * (self.f_i.z * t42));
            let t47 = j_e0 * j_e0_d;
            let t48 = j_e0_d * j_e0_d;
            let t49 = t47 + (j_e1 * j_e1_d);
            let t50 = t48 + (j_e1_d * j_e1_d);
            let t51 = (j_e2 * j_e1_d) + (j_e1 * j_e2_d);
            let t52 = j_e1_d * j_e2_d;
            let t53 = (j_e3 * j_e0_d) + (j_e0 * j_e3_d);
            let t54 = j_e0_d * j_e3_d;
            let t55 = t51 - t53;
            let t56 = t52 - t54;
            let t57 = (j_e3 * j_e1_d) + (j_e1 * j_e3_d);
            let t58 = j_e1_d * j_e3_d;
            let t59 = (j_e2 * j_e0_d) + (j_e0 * j_e2_d);
            let t60 = j_e0_d * j_e2_d;
            let t61 = t57 + t59;
            let t62 = t58 + t60;
            let t63 = t51 + t53;
            let t64 = t52 + t54;
            let t65 = t47 + (j_e2 * j_e2_d);
            let t66 = t48 + (j_e2_d * j_e2_d);
            let t67 = (j_e3 * j_e2_d) + (j_e2 * j_e3_d);
            let t68 = j_e2_d * j_e3_d;
            let t69 = (j_e1 * j_e0_d) + (j_e0 * j_e1_d);
            let t70 = j_e0_d * j_e1_d;
            let t71 = t67 - t69;
            let t72 = t68 - t70;
            let t73 = t57 - t59;
            let t74 = t58 - t60;
            let t75 = t67 + t69;
            let t76 = t68 + t70;
            let t77 = t47 + (j_e3 * j_e3_d);
            let t78 = t48 + (j_e3_d * j_e3_d);
            let t79 = ((self.h_j.y * t55) + (2.0 * (self.h_j.x * t49)))
                + (self.h_j.z * t61);
            let t80 = ((self.h_j.x * t63) + (2.0 * (self.h_j.y * t65)))
                + (self.h_j.z * t71);
            let t81 = ((self.h_j.x * t73) + (self.h_j.y * t75))
                + (2.0 * (self.h_j.z * t77));
            let t82 = ((self.f_i.x * t15) + (self.f_i.y * t21)) + (self.f_i.z * t27);
            let t83 = ((self.f_i.x * t29) + (self.f_i.y * t31)) + (self.f_i.z * t37);
            let t84 = ((self.f_i.x * t39) + (self.f_i.y * t41)) + (self.f_i.z * t43);
            let t85 = ((self.h_j.x * t50) + (self.h_j.y * t56)) + (self.h_j.z * t62);
            let t86 = ((self.h_j.x * t64) + (self.h_j.y * t66)) + (self.h_j.z * t72);
            let t87 = ((self.h_j.x * t74) + (self.h_j.y * t76)) + (self.h_j.z * t78);
            let t88 = 4.0
                * (((((t6 * t82) + (t0 * t85)) + (2.0 * (t44 * t79)))
                    + (((t7 * t83) + (t1 * t86)) + (2.0 * (t45 * t80))))
                    + (((t8 * t84) + (t2 * t87)) + (2.0 * (t46 * t81))));
            let t89 = ((self.g_i.y * t20) + (2.0 * (self.g_i.x * t14)))
                + (self.g_i.z * t26);
            let t90 = ((self.g_i.x * t28) + (2.0 * (self.g_i.y * t30)))
                + (self.g_i.z * t36);
            let t91 = ((self.g_i.x * t38) + (self.g_i.y * t40))
                + (2.0 * (self.g_i.z * t42));
            let t92 = ((self.g_i.x * t15) + (self.g_i.y * t21)) + (self.g_i.z * t27);
            let t93 = ((self.g_i.x * t29) + (self.g_i.y * t31)) + (self.g_i.z * t37);
            let t94 = ((self.g_i.x * t39) + (self.g_i.y * t41)) + (self.g_i.z * t43);
            let t95 = 4.0
                * (((((t6 * t92) + (t3 * t85)) + (2.0 * (t79 * t89)))
                    + (((t7 * t93) + (t4 * t86)) + (2.0 * (t80 * t90))))
                    + (((t8 * t94) + (t5 * t87)) + (2.0 * (t81 * t91))));
            let t96 = i_x_d
                + (2.0
                    * (((self.u_i.y * t20) + (2.0 * (self.u_i.x * t14)))
                        + (self.u_i.z * t26)));
            let t97 = i_y_d
                + (2.0
                    * (((self.u_i.x * t28) + (2.0 * (self.u_i.y * t30)))
                        + (self.u_i.z * t36)));
            let t98 = j_x_d
                + (2.0
                    * (((self.u_j.y * t55) + (2.0 * (self.u_j.x * t49)))
                        + (self.u_j.z * t61)));
            let t99 = j_y_d
                + (2.0
                    * (((self.u_j.x * t63) + (2.0 * (self.u_j.y * t65)))
                        + (self.u_j.z * t71)));
            let t100 = t96 - t98;
            let t101 = t97 - t99;
            let t102 = (i_z_d
                + (2.0
                    * (((self.u_i.x * t38) + (self.u_i.y * t40))
                        + (2.0 * (self.u_i.z * t42)))))
                - (j_z_d
                    + (2.0
                        * (((self.u_j.x * t73) + (self.u_j.y * t75))
                            + (2.0 * (self.u_j.z * t77)))));
            let t103 = (((self.u_i.x * t15) + (self.u_i.y * t21)) + (self.u_i.z * t27))
                - (((self.u_j.x * t50) + (self.u_j.y * t56)) + (self.u_j.z * t62));
            let t104 = (((self.u_i.x * t29) + (self.u_i.y * t31)) + (self.u_i.z * t37))
                - (((self.u_j.x * t64) + (self.u_j.y * t66)) + (self.u_j.z * t72));
            let t105 = (((self.u_i.x * t39) + (self.u_i.y * t41)) + (self.u_i.z * t43))
                - (((self.u_j.x * t74) + (self.u_j.y * t76)) + (self.u_j.z * t78));
            let t106 = 4.0
                * ((((t44 * t100) + ((t9 * t82) + (t0 * t103)))
                    + ((t45 * t101) + ((t10 * t83) + (t1 * t104))))
                    + ((t46 * t102) + ((t11 * t84) + (t2 * t105))));
            let t107 = 4.0
                * ((((t89 * t100) + ((t9 * t92) + (t3 * t103)))
                    + ((t90 * t101) + ((t10 * t93) + (t4 * t104))))
                    + ((t91 * t102) + ((t11 * t94) + (t5 * t105))));
            q_d[0] = -t88;
            q_d[1] = -t95;
            q_d[2] = -t106;
            q_d[3] = -t107;
        }
        fn attachments(&self) -> ::std::vec::Vec<::kin::rt::Attachment> {
            let mut u = [[0.0_f64; 3]; 5];
            u[0][0] = self.f_i.x;
            u[0][1] = self.f_i.y;
            u[0][2] = self.f_i.z;
            u[1][0] = self.g_i.x;
            u[1][1] = self.g_i.y;
            u[1][2] = self.g_i.z;
            u[2][0] = self.h_j.x;
            u[2][1] = self.h_j.y;
            u[2][2] = self.h_j.z;
            u[3][0] = self.u_i.x;
            u[3][1] = self.u_i.y;
            u[3][2] = self.u_i.z;
            u[4][0] = self.u_j.x;
            u[4][1] = self.u_j.y;
            u[4][2] = self.u_j.z;
            ::std::vec![
                ::kin::rt::attachment(0, false, u[0]), ::kin::rt::attachment(0, false,
                u[1]), ::kin::rt::attachment(1, false, u[2]), ::kin::rt::attachment(0,
                true, u[3]), ::kin::rt::attachment(1, true, u[4])
            ]
        }
        fn description(&self) -> &str {
            "A cylindrical joint: the axes are parallel and the line between two of their points is along them.      [–, –, m, m]"
        }
        fn parameters(&self, visit: &mut dyn FnMut(&str, f64)) {
            ::kin::rt::Numbers::visit(&self.u_i, "u_i", visit);
            ::kin::rt::Numbers::visit(&self.u_j, "u_j", visit);
            ::kin::rt::Numbers::visit(&self.f_i, "f_i", visit);
            ::kin::rt::Numbers::visit(&self.g_i, "g_i", visit);
            ::kin::rt::Numbers::visit(&self.h_j, "h_j", visit);
        }
        fn set_parameter(&mut self, name: &str, value: f64) -> bool {
            ::kin::rt::Numbers::set(&mut self.u_i, "u_i", name, value)
                || ::kin::rt::Numbers::set(&mut self.u_j, "u_j", name, value)
                || ::kin::rt::Numbers::set(&mut self.f_i, "f_i", name, value)
                || ::kin::rt::Numbers::set(&mut self.g_i, "g_i", name, value)
                || ::kin::rt::Numbers::set(&mut self.h_j, "h_j", name, value)
        }
        fn set_parameter_at(&mut self, mut index: usize, value: f64) -> bool {
            ::kin::rt::Numbers::set_at(&mut self.u_i, &mut index, value)
                || ::kin::rt::Numbers::set_at(&mut self.u_j, &mut index, value)
                || ::kin::rt::Numbers::set_at(&mut self.f_i, &mut index, value)
                || ::kin::rt::Numbers::set_at(&mut self.g_i, &mut index, value)
                || ::kin::rt::Numbers::set_at(&mut self.h_j, &mut index, value)
        }
    }
    impl ::kin::rt::Described for cylindrical {
        const KIND: &'static str = "cylindrical";
        const ARGUMENTS: &'static [::kin::rt::ArgumentKind] = <Self as ::kin::rt::Equation<
            14,
            4,
        >>::ARGUMENTS;
        fn read(
            from: &mut ::kin::rt::Reader<'_>,
        ) -> ::core::result::Result<Self, ::std::string::String> {
            use ::kin::rt::{SoughtBySerde as _, Unsought as _};
            ::core::result::Result::Ok(cylindrical {
                i: from.spatial()?,
                j: from.spatial()?,
                u_i: from.get("u_i")?,
                u_j: from.get("u_j")?,
                f_i: from.get("f_i")?,
                g_i: from.get("g_i")?,
                h_j: from.get("h_j")?,
            })
        }
    }
    impl ::kin::rt::Equation<14, 4> for cylindrical {
        const ARGUMENTS: &'static [::kin::rt::ArgumentKind] = &[
            ::kin::rt::ArgumentKind::Spatial,
            ::kin::rt::ArgumentKind::Spatial,
        ];
        fn evaluate<__D: ::kin::rt::Dual>(
            &self,
            q: &[::kin::rt::Real<__D>; 14],
            t: ::kin::rt::Real<__D>,
        ) -> [::kin::rt::Real<__D>; 4] {
            let i = ::kin::rt::SpatialState::<
                __Real<__D>,
            >::new([q[0], q[1], q[2], q[3], q[4], q[5], q[6]]);
            let j = ::kin::rt::SpatialState::<
                __Real<__D>,
            >::new([q[7], q[8], q[9], q[10], q[11], q[12], q[13]]);
            let u_i: ::kin::rt::Vec3<__Real<__D>> = ::kin::rt::Lift::lift(self.u_i);
            let u_j: ::kin::rt::Vec3<__Real<__D>> = ::kin::rt::Lift::lift(self.u_j);
            let f_i: ::kin::rt::Vec3<__Real<__D>> = ::kin::rt::Lift::lift(self.f_i);
            let g_i: ::kin::rt::Vec3<__Real<__D>> = ::kin::rt::Lift::lift(self.g_i);
            let h_j: ::kin::rt::Vec3<__Real<__D>> = ::kin::rt::Lift::lift(self.h_j);
            let value = (move || -> (__Real<__D>, __Real<__D>, __Real<__D>, __Real<__D>) {
                let (f, g, h) = (i.direction(f_i), i.direction(g_i), j.direction(h_j));
                let d = i.point(u_i) - j.point(u_j);
                (f.dot(h), g.dot(h), f.dot(d), g.dot(d))
            })();
            ::kin::rt::rows(value)
        }
        #[inline]
        fn plain(&self, q: &[f64; 14], t: f64) -> [f64; 4] {
            ::kin::rt::rows(
                __WRITTEN(
                    ::kin::rt::SpatialState::new([
                        q[0],
                        q[1],
                        q[2],
                        q[3],
                        q[4],
                        q[5],
                        q[6],
                    ]),
                    ::kin::rt::SpatialState::new([
                        q[7],
                        q[8],
                        q[9],
                        q[10],
                        q[11],
                        q[12],
                        q[13],
                    ]),
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
