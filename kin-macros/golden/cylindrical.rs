/** The constraint that [`fn@cylindrical`] makes.

*/
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
    const _: fn() = || {};
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
        /// C_q: 571 operations
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
            let t15 = ((4.0 * t12) - (2.0 * t13)) + (2.0 * t14);
            let t16 = self.f_i.x * i_e3;
            let t17 = self.f_i.y * i_e0;
            let t18 = self.f_i.z * i_e1;
            let t19 = ((2.0 * t16) + (4.0 * t17)) - (2.0 * t18);
            let t20 = self.f_i.x * i_e2;
            let t21 = self.f_i.y * i_e1;
            let t22 = self.f_i.z * i_e0;
            let t23 = (2.0 * (t21 - t20)) + (4.0 * t22);
            let t24 = self.f_i.x * i_e1;
            let t25 = self.f_i.y * i_e2;
            let t26 = self.f_i.z * i_e3;
            let t27 = 2.0 * t26;
            let t28 = ((4.0 * t24) + (2.0 * t25)) + t27;
            let t29 = t20 - t22;
            let t30 = t16 + t17;
            let t31 = t21 + t22;
            let t32 = t27 + ((2.0 * t24) + (4.0 * t25));
            let t33 = t13 - t12;
            let t34 = t18 - t17;
            let t35 = t12 + t14;
            let t36 = (2.0 * (t24 + t25)) + (4.0 * t26);
            let t37 = self.h_j.x * j_e0;
            let t38 = self.h_j.y * j_e3;
            let t39 = self.h_j.z * j_e2;
            let t40 = ((4.0 * t37) - (2.0 * t38)) + (2.0 * t39);
            let t41 = self.h_j.x * j_e3;
            let t42 = self.h_j.y * j_e0;
            let t43 = self.h_j.z * j_e1;
            let t44 = ((2.0 * t41) + (4.0 * t42)) - (2.0 * t43);
            let t45 = self.h_j.x * j_e2;
            let t46 = self.h_j.y * j_e1;
            let t47 = self.h_j.z * j_e0;
            let t48 = (2.0 * (t46 - t45)) + (4.0 * t47);
            let t49 = self.h_j.x * j_e1;
            let t50 = self.h_j.y * j_e2;
            let t51 = self.h_j.z * j_e3;
            let t52 = 2.0 * t51;
            let t53 = ((4.0 * t49) + (2.0 * t50)) + t52;
            let t54 = t45 - t47;
            let t55 = t41 + t42;
            let t56 = t46 + t47;
            let t57 = t52 + ((2.0 * t49) + (4.0 * t50));
            let t58 = t38 - t37;
            let t59 = t43 - t42;
            let t60 = t37 + t39;
            let t61 = (2.0 * (t49 + t50)) + (4.0 * t51);
            let t62 = self.g_i.x * i_e0;
            let t63 = self.g_i.y * i_e3;
            let t64 = self.g_i.z * i_e2;
            let t65 = ((4.0 * t62) - (2.0 * t63)) + (2.0 * t64);
            let t66 = self.g_i.x * i_e3;
            let t67 = self.g_i.y * i_e0;
            let t68 = self.g_i.z * i_e1;
            let t69 = ((2.0 * t66) + (4.0 * t67)) - (2.0 * t68);
            let t70 = self.g_i.x * i_e2;
            let t71 = self.g_i.y * i_e1;
            let t72 = self.g_i.z * i_e0;
            let t73 = (2.0 * (t71 - t70)) + (4.0 * t72);
            let t74 = self.g_i.x * i_e1;
            let t75 = self.g_i.y * i_e2;
            let t76 = self.g_i.z * i_e3;
            let t77 = 2.0 * t76;
            let t78 = ((4.0 * t74) + (2.0 * t75)) + t77;
            let t79 = t70 - t72;
            let t80 = t66 + t67;
            let t81 = t71 + t72;
            let t82 = t77 + ((2.0 * t74) + (4.0 * t75));
            let t83 = t63 - t62;
            let t84 = t68 - t67;
            let t85 = t62 + t64;
            let t86 = (2.0 * (t74 + t75)) + (4.0 * t76);
            let t87 = self.u_i.x * i_e0;
            let t88 = self.u_i.y * i_e3;
            let t89 = self.u_i.z * i_e2;
            let t90 = ((4.0 * t87) - (2.0 * t88)) + (2.0 * t89);
            let t91 = self.u_i.x * i_e3;
            let t92 = self.u_i.y * i_e0;
            let t93 = self.u_i.z * i_e1;
            let t94 = ((2.0 * t91) + (4.0 * t92)) - (2.0 * t93);
            let t95 = self.u_i.x * i_e2;
            let t96 = self.u_i.y * i_e1;
            let t97 = self.u_i.z * i_e0;
            let t98 = (2.0 * (t96 - t95)) + (4.0 * t97);
            let t99 = self.u_i.x * i_e1;
            let t100 = self.u_i.y * i_e2;
            let t101 = self.u_i.z * i_e3;
            let t102 = 2.0 * t101;
            let t103 = ((4.0 * t99) + (2.0 * t100)) + t102;
            let t104 = t95 - t97;
            let t105 = t91 + t92;
            let t106 = t96 + t97;
            let t107 = t102 + ((2.0 * t99) + (4.0 * t100));
            let t108 = t88 - t87;
            let t109 = t93 - t92;
            let t110 = t87 + t89;
            let t111 = (2.0 * (t99 + t100)) + (4.0 * t101);
            let t112 = self.u_j.x * j_e0;
            let t113 = self.u_j.y * j_e3;
            let t114 = self.u_j.z * j_e2;
            let t115 = ((4.0 * t112) - (2.0 * t113)) + (2.0 * t114);
            let t116 = self.u_j.x * j_e3;
            let t117 = self.u_j.y * j_e0;
            let t118 = self.u_j.z * j_e1;
            let t119 = ((2.0 * t116) + (4.0 * t117)) - (2.0 * t118);
            let t120 = self.u_j.x * j_e2;
            let t121 = self.u_j.y * j_e1;
            let t122 = self.u_j.z * j_e0;
            let t123 = (2.0 * (t121 - t120)) + (4.0 * t122);
            let t124 = self.u_j.x * j_e1;
            let t125 = self.u_j.y * j_e2;
            let t126 = self.u_j.z * j_e3;
            let t127 = 2.0 * t126;
            let t128 = ((4.0 * t124) + (2.0 * t125)) + t127;
            let t129 = t120 - t122;
            let t130 = t116 + t117;
            let t131 = t121 + t122;
            let t132 = t127 + ((2.0 * t124) + (4.0 * t125));
            let t133 = t113 - t112;
            let t134 = t118 - t117;
            let t135 = t112 + t114;
            let t136 = (2.0 * (t124 + t125)) + (4.0 * t126);
            c_q[0] = ((t6 * t15) + (t7 * t19)) + (t8 * t23);
            c_q[1] = ((t6 * t28) + (2.0 * (t7 * t29))) + (2.0 * (t8 * t30));
            c_q[2] = ((2.0 * (t6 * t31)) + (t7 * t32)) + (2.0 * (t8 * t33));
            c_q[3] = (2.0 * ((t6 * t34) + (t7 * t35))) + (t8 * t36);
            c_q[4] = ((t0 * t40) + (t1 * t44)) + (t2 * t48);
            c_q[5] = ((t0 * t53) + (2.0 * (t1 * t54))) + (2.0 * (t2 * t55));
            c_q[6] = ((2.0 * (t0 * t56)) + (t1 * t57)) + (2.0 * (t2 * t58));
            c_q[7] = (2.0 * ((t0 * t59) + (t1 * t60))) + (t2 * t61);
            c_q[8] = ((t6 * t65) + (t7 * t69)) + (t8 * t73);
            c_q[9] = ((t6 * t78) + (2.0 * (t7 * t79))) + (2.0 * (t8 * t80));
            c_q[10] = ((2.0 * (t6 * t81)) + (t7 * t82)) + (2.0 * (t8 * t83));
            c_q[11] = (2.0 * ((t6 * t84) + (t7 * t85))) + (t8 * t86);
            c_q[12] = ((t3 * t40) + (t4 * t44)) + (t5 * t48);
            c_q[13] = ((t3 * t53) + (2.0 * (t4 * t54))) + (2.0 * (t5 * t55));
            c_q[14] = ((2.0 * (t3 * t56)) + (t4 * t57)) + (2.0 * (t5 * t58));
            c_q[15] = (2.0 * ((t3 * t59) + (t4 * t60))) + (t5 * t61);
            c_q[16] = t0;
            c_q[17] = t1;
            c_q[18] = t2;
            c_q[19] = (((t9 * t15) + (t0 * t90)) + ((t10 * t19) + (t1 * t94)))
                + ((t11 * t23) + (t2 * t98));
            c_q[20] = (((t9 * t28) + (t0 * t103)) + (2.0 * ((t10 * t29) + (t1 * t104))))
                + (2.0 * ((t11 * t30) + (t2 * t105)));
            c_q[21] = ((2.0 * ((t9 * t31) + (t0 * t106))) + ((t10 * t32) + (t1 * t107)))
                + (2.0 * ((t11 * t33) + (t2 * t108)));
            c_q[22] = (2.0 * (((t9 * t34) + (t0 * t109)) + ((t10 * t35) + (t1 * t110))))
                + ((t11 * t36) + (t2 * t111));
            c_q[23] = -t0;
            c_q[24] = -t1;
            c_q[25] = -t2;
            c_q[26] = -(((t0 * t115) + (t1 * t119)) + (t2 * t123));
            c_q[27] = -(((t0 * t128) + (2.0 * (t1 * t129))) + (2.0 * (t2 * t130)));
            c_q[28] = -(((2.0 * (t0 * t131)) + (t1 * t132)) + (2.0 * (t2 * t133)));
            c_q[29] = -((2.0 * ((t0 * t134) + (t1 * t135))) + (t2 * t136));
            c_q[30] = t3;
            c_q[31] = t4;
            c_q[32] = t5;
            c_q[33] = (((t9 * t65) + (t3 * t90)) + ((t10 * t69) + (t4 * t94)))
                + ((t11 * t73) + (t5 * t98));
            c_q[34] = (((t9 * t78) + (t3 * t103)) + (2.0 * ((t10 * t79) + (t4 * t104))))
                + (2.0 * ((t11 * t80) + (t5 * t105)));
            c_q[35] = ((2.0 * ((t9 * t81) + (t3 * t106))) + ((t10 * t82) + (t4 * t107)))
                + (2.0 * ((t11 * t83) + (t5 * t108)));
            c_q[36] = (2.0 * (((t9 * t84) + (t3 * t109)) + ((t10 * t85) + (t4 * t110))))
                + ((t11 * t86) + (t5 * t111));
            c_q[37] = -t3;
            c_q[38] = -t4;
            c_q[39] = -t5;
            c_q[40] = -(((t3 * t115) + (t4 * t119)) + (t5 * t123));
            c_q[41] = -(((t3 * t128) + (2.0 * (t4 * t129))) + (2.0 * (t5 * t130)));
            c_q[42] = -(((2.0 * (t3 * t131)) + (t4 * t132)) + (2.0 * (t5 * t133)));
            c_q[43] = -((2.0 * ((t3 * t134) + (t4 * t135))) + (t5 * t136));
        }
        /// C and C_q: 591 operations
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
            let t15 = ((4.0 * t12) - (2.0 * t13)) + (2.0 * t14);
            let t16 = self.f_i.x * i_e3;
            let t17 = self.f_i.y * i_e0;
            let t18 = self.f_i.z * i_e1;
            let t19 = ((2.0 * t16) + (4.0 * t17)) - (2.0 * t18);
            let t20 = self.f_i.x * i_e2;
            let t21 = self.f_i.y * i_e1;
            let t22 = self.f_i.z * i_e0;
            let t23 = (2.0 * (t21 - t20)) + (4.0 * t22);
            let t24 = self.f_i.x * i_e1;
            let t25 = self.f_i.y * i_e2;
            let t26 = self.f_i.z * i_e3;
            let t27 = 2.0 * t26;
            let t28 = ((4.0 * t24) + (2.0 * t25)) + t27;
            let t29 = t20 - t22;
            let t30 = t16 + t17;
            let t31 = t21 + t22;
            let t32 = t27 + ((2.0 * t24) + (4.0 * t25));
            let t33 = t13 - t12;
            let t34 = t18 - t17;
            let t35 = t12 + t14;
            let t36 = (2.0 * (t24 + t25)) + (4.0 * t26);
            let t37 = self.h_j.x * j_e0;
            let t38 = self.h_j.y * j_e3;
            let t39 = self.h_j.z * j_e2;
            let t40 = ((4.0 * t37) - (2.0 * t38)) + (2.0 * t39);
            let t41 = self.h_j.x * j_e3;
            let t42 = self.h_j.y * j_e0;
            let t43 = self.h_j.z * j_e1;
            let t44 = ((2.0 * t41) + (4.0 * t42)) - (2.0 * t43);
            let t45 = self.h_j.x * j_e2;
            let t46 = self.h_j.y * j_e1;
            let t47 = self.h_j.z * j_e0;
            let t48 = (2.0 * (t46 - t45)) + (4.0 * t47);
            let t49 = self.h_j.x * j_e1;
            let t50 = self.h_j.y * j_e2;
            let t51 = self.h_j.z * j_e3;
            let t52 = 2.0 * t51;
            let t53 = ((4.0 * t49) + (2.0 * t50)) + t52;
            let t54 = t45 - t47;
            let t55 = t41 + t42;
            let t56 = t46 + t47;
            let t57 = t52 + ((2.0 * t49) + (4.0 * t50));
            let t58 = t38 - t37;
            let t59 = t43 - t42;
            let t60 = t37 + t39;
            let t61 = (2.0 * (t49 + t50)) + (4.0 * t51);
            let t62 = self.g_i.x * i_e0;
            let t63 = self.g_i.y * i_e3;
            let t64 = self.g_i.z * i_e2;
            let t65 = ((4.0 * t62) - (2.0 * t63)) + (2.0 * t64);
            let t66 = self.g_i.x * i_e3;
            let t67 = self.g_i.y * i_e0;
            let t68 = self.g_i.z * i_e1;
            let t69 = ((2.0 * t66) + (4.0 * t67)) - (2.0 * t68);
            let t70 = self.g_i.x * i_e2;
            let t71 = self.g_i.y * i_e1;
            let t72 = self.g_i.z * i_e0;
            let t73 = (2.0 * (t71 - t70)) + (4.0 * t72);
            let t74 = self.g_i.x * i_e1;
            let t75 = self.g_i.y * i_e2;
            let t76 = self.g_i.z * i_e3;
            let t77 = 2.0 * t76;
            let t78 = ((4.0 * t74) + (2.0 * t75)) + t77;
            let t79 = t70 - t72;
            let t80 = t66 + t67;
            let t81 = t71 + t72;
            let t82 = t77 + ((2.0 * t74) + (4.0 * t75));
            let t83 = t63 - t62;
            let t84 = t68 - t67;
            let t85 = t62 + t64;
            let t86 = (2.0 * (t74 + t75)) + (4.0 * t76);
            let t87 = self.u_i.x * i_e0;
            let t88 = self.u_i.y * i_e3;
            let t89 = self.u_i.z * i_e2;
            let t90 = ((4.0 * t87) - (2.0 * t88)) + (2.0 * t89);
            let t91 = self.u_i.x * i_e3;
            let t92 = self.u_i.y * i_e0;
            let t93 = self.u_i.z * i_e1;
            let t94 = ((2.0 * t91) + (4.0 * t92)) - (2.0 * t93);
            let t95 = self.u_i.x * i_e2;
            let t96 = self.u_i.y * i_e1;
            let t97 = self.u_i.z * i_e0;
            let t98 = (2.0 * (t96 - t95)) + (4.0 * t97);
            let t99 = self.u_i.x * i_e1;
            let t100 = self.u_i.y * i_e2;
            let t101 = self.u_i.z * i_e3;
            let t102 = 2.0 * t101;
            let t103 = ((4.0 * t99) + (2.0 * t100)) + t102;
            let t104 = t95 - t97;
            let t105 = t91 + t92;
            let t106 = t96 + t97;
            let t107 = t102 + ((2.0 * t99) + (4.0 * t100));
            let t108 = t88 - t87;
            let t109 = t93 - t92;
            let t110 = t87 + t89;
            let t111 = (2.0 * (t99 + t100)) + (4.0 * t101);
            let t112 = self.u_j.x * j_e0;
            let t113 = self.u_j.y * j_e3;
            let t114 = self.u_j.z * j_e2;
            let t115 = ((4.0 * t112) - (2.0 * t113)) + (2.0 * t114);
            let t116 = self.u_j.x * j_e3;
            let t117 = self.u_j.y * j_e0;
            let t118 = self.u_j.z * j_e1;
            let t119 = ((2.0 * t116) + (4.0 * t117)) - (2.0 * t118);
            let t120 = self.u_j.x * j_e2;
            let t121 = self.u_j.y * j_e1;
            let t122 = self.u_j.z * j_e0;
            let t123 = (2.0 * (t121 - t120)) + (4.0 * t122);
            let t124 = self.u_j.x * j_e1;
            let t125 = self.u_j.y * j_e2;
            let t126 = self.u_j.z * j_e3;
            let t127 = 2.0 * t126;
            let t128 = ((4.0 * t124) + (2.0 * t125)) + t127;
            let t129 = t120 - t122;
            let t130 = t116 + t117;
            let t131 = t121 + t122;
            let t132 = t127 + ((2.0 * t124) + (4.0 * t125));
            let t133 = t113 - t112;
            let t134 = t118 - t117;
            let t135 = t112 + t114;
            let t136 = (2.0 * (t124 + t125)) + (4.0 * t126);
            c[0] = ((t0 * t6) + (t1 * t7)) + (t2 * t8);
            c[1] = ((t3 * t6) + (t4 * t7)) + (t5 * t8);
            c[2] = ((t0 * t9) + (t1 * t10)) + (t2 * t11);
            c[3] = ((t3 * t9) + (t4 * t10)) + (t5 * t11);
            c_q[0] = ((t6 * t15) + (t7 * t19)) + (t8 * t23);
            c_q[1] = ((t6 * t28) + (2.0 * (t7 * t29))) + (2.0 * (t8 * t30));
            c_q[2] = ((2.0 * (t6 * t31)) + (t7 * t32)) + (2.0 * (t8 * t33));
            c_q[3] = (2.0 * ((t6 * t34) + (t7 * t35))) + (t8 * t36);
            c_q[4] = ((t0 * t40) + (t1 * t44)) + (t2 * t48);
            c_q[5] = ((t0 * t53) + (2.0 * (t1 * t54))) + (2.0 * (t2 * t55));
            c_q[6] = ((2.0 * (t0 * t56)) + (t1 * t57)) + (2.0 * (t2 * t58));
            c_q[7] = (2.0 * ((t0 * t59) + (t1 * t60))) + (t2 * t61);
            c_q[8] = ((t6 * t65) + (t7 * t69)) + (t8 * t73);
            c_q[9] = ((t6 * t78) + (2.0 * (t7 * t79))) + (2.0 * (t8 * t80));
            c_q[10] = ((2.0 * (t6 * t81)) + (t7 * t82)) + (2.0 * (t8 * t83));
            c_q[11] = (2.0 * ((t6 * t84) + (t7 * t85))) + (t8 * t86);
            c_q[12] = ((t3 * t40) + (t4 * t44)) + (t5 * t48);
            c_q[13] = ((t3 * t53) + (2.0 * (t4 * t54))) + (2.0 * (t5 * t55));
            c_q[14] = ((2.0 * (t3 * t56)) + (t4 * t57)) + (2.0 * (t5 * t58));
            c_q[15] = (2.0 * ((t3 * t59) + (t4 * t60))) + (t5 * t61);
            c_q[16] = t0;
            c_q[17] = t1;
            c_q[18] = t2;
            c_q[19] = (((t9 * t15) + (t0 * t90)) + ((t10 * t19) + (t1 * t94)))
                + ((t11 * t23) + (t2 * t98));
            c_q[20] = (((t9 * t28) + (t0 * t103)) + (2.0 * ((t10 * t29) + (t1 * t104))))
                + (2.0 * ((t11 * t30) + (t2 * t105)));
            c_q[21] = ((2.0 * ((t9 * t31) + (t0 * t106))) + ((t10 * t32) + (t1 * t107)))
                + (2.0 * ((t11 * t33) + (t2 * t108)));
            c_q[22] = (2.0 * (((t9 * t34) + (t0 * t109)) + ((t10 * t35) + (t1 * t110))))
                + ((t11 * t36) + (t2 * t111));
            c_q[23] = -t0;
            c_q[24] = -t1;
            c_q[25] = -t2;
            c_q[26] = -(((t0 * t115) + (t1 * t119)) + (t2 * t123));
            c_q[27] = -(((t0 * t128) + (2.0 * (t1 * t129))) + (2.0 * (t2 * t130)));
            c_q[28] = -(((2.0 * (t0 * t131)) + (t1 * t132)) + (2.0 * (t2 * t133)));
            c_q[29] = -((2.0 * ((t0 * t134) + (t1 * t135))) + (t2 * t136));
            c_q[30] = t3;
            c_q[31] = t4;
            c_q[32] = t5;
            c_q[33] = (((t9 * t65) + (t3 * t90)) + ((t10 * t69) + (t4 * t94)))
                + ((t11 * t73) + (t5 * t98));
            c_q[34] = (((t9 * t78) + (t3 * t103)) + (2.0 * ((t10 * t79) + (t4 * t104))))
                + (2.0 * ((t11 * t80) + (t5 * t105)));
            c_q[35] = ((2.0 * ((t9 * t81) + (t3 * t106))) + ((t10 * t82) + (t4 * t107)))
                + (2.0 * ((t11 * t83) + (t5 * t108)));
            c_q[36] = (2.0 * (((t9 * t84) + (t3 * t109)) + ((t10 * t85) + (t4 * t110))))
                + ((t11 * t86) + (t5 * t111));
            c_q[37] = -t3;
            c_q[38] = -t4;
            c_q[39] = -t5;
            c_q[40] = -(((t3 * t115) + (t4 * t119)) + (t5 * t123));
            c_q[41] = -(((t3 * t128) + (2.0 * (t4 * t129))) + (2.0 * (t5 * t130)));
            c_q[42] = -(((2.0 * (t3 * t131)) + (t4 * t132)) + (2.0 * (t5 * t133)));
            c_q[43] = -((2.0 * ((t3 * t134) + (t4 * t135))) + (t5 * t136));
        }
        fn velocity_rhs(&self, _at: &::kin::rt::At<'_>, rhs: &mut [f64]) {
            rhs.iter_mut().take(4).for_each(|value| *value = 0.0);
        }
        /// Q_d for t_dot = 1: 482 operations
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
            let t44 = ((4.0 * (self.f_i.x * t14)) + (2.0 * (self.f_i.y * t20)))
                + (2.0 * (self.f_i.z * t26));
            let t45 = ((2.0 * (self.f_i.x * t28)) + (4.0 * (self.f_i.y * t30)))
                + (2.0 * (self.f_i.z * t36));
            let t46 = (2.0 * ((self.f_i.x * t38) + (self.f_i.y * t40)))
                + (4.0 * (self.f_i.z * t42));
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
            let t79 = ((4.0 * (self.h_j.x * t49)) + (2.0 * (self.h_j.y * t55)))
                + (2.0 * (self.h_j.z * t61));
            let t80 = ((2.0 * (self.h_j.x * t63)) + (4.0 * (self.h_j.y * t65)))
                + (2.0 * (self.h_j.z * t71));
            let t81 = (2.0 * ((self.h_j.x * t73) + (self.h_j.y * t75)))
                + (4.0 * (self.h_j.z * t77));
            let t82 = ((self.f_i.x * t15) + (self.f_i.y * t21)) + (self.f_i.z * t27);
            let t83 = ((self.f_i.x * t29) + (self.f_i.y * t31)) + (self.f_i.z * t37);
            let t84 = ((self.f_i.x * t39) + (self.f_i.y * t41)) + (self.f_i.z * t43);
            let t85 = ((self.h_j.x * t50) + (self.h_j.y * t56)) + (self.h_j.z * t62);
            let t86 = ((self.h_j.x * t64) + (self.h_j.y * t66)) + (self.h_j.z * t72);
            let t87 = ((self.h_j.x * t74) + (self.h_j.y * t76)) + (self.h_j.z * t78);
            let t88 = (((2.0 * (t44 * t79)) + (4.0 * ((t6 * t82) + (t0 * t85))))
                + ((2.0 * (t45 * t80)) + (4.0 * ((t7 * t83) + (t1 * t86)))))
                + ((2.0 * (t46 * t81)) + (4.0 * ((t8 * t84) + (t2 * t87))));
            let t89 = ((4.0 * (self.g_i.x * t14)) + (2.0 * (self.g_i.y * t20)))
                + (2.0 * (self.g_i.z * t26));
            let t90 = ((2.0 * (self.g_i.x * t28)) + (4.0 * (self.g_i.y * t30)))
                + (2.0 * (self.g_i.z * t36));
            let t91 = (2.0 * ((self.g_i.x * t38) + (self.g_i.y * t40)))
                + (4.0 * (self.g_i.z * t42));
            let t92 = ((self.g_i.x * t15) + (self.g_i.y * t21)) + (self.g_i.z * t27);
            let t93 = ((self.g_i.x * t29) + (self.g_i.y * t31)) + (self.g_i.z * t37);
            let t94 = ((self.g_i.x * t39) + (self.g_i.y * t41)) + (self.g_i.z * t43);
            let t95 = (((2.0 * (t79 * t89)) + (4.0 * ((t6 * t92) + (t3 * t85))))
                + ((2.0 * (t80 * t90)) + (4.0 * ((t7 * t93) + (t4 * t86)))))
                + ((2.0 * (t81 * t91)) + (4.0 * ((t8 * t94) + (t5 * t87))));
            let t96 = (i_x_d
                + (((4.0 * (self.u_i.x * t14)) + (2.0 * (self.u_i.y * t20)))
                    + (2.0 * (self.u_i.z * t26))))
                - (j_x_d
                    + (((4.0 * (self.u_j.x * t49)) + (2.0 * (self.u_j.y * t55)))
                        + (2.0 * (self.u_j.z * t61))));
            let t97 = (i_y_d
                + (((2.0 * (self.u_i.x * t28)) + (4.0 * (self.u_i.y * t30)))
                    + (2.0 * (self.u_i.z * t36))))
                - (j_y_d
                    + (((2.0 * (self.u_j.x * t63)) + (4.0 * (self.u_j.y * t65)))
                        + (2.0 * (self.u_j.z * t71))));
            let t98 = (i_z_d
                + ((2.0 * ((self.u_i.x * t38) + (self.u_i.y * t40)))
                    + (4.0 * (self.u_i.z * t42))))
                - (j_z_d
                    + ((2.0 * ((self.u_j.x * t73) + (self.u_j.y * t75)))
                        + (4.0 * (self.u_j.z * t77))));
            let t99 = (((self.u_i.x * t15) + (self.u_i.y * t21)) + (self.u_i.z * t27))
                - (((self.u_j.x * t50) + (self.u_j.y * t56)) + (self.u_j.z * t62));
            let t100 = (((self.u_i.x * t29) + (self.u_i.y * t31)) + (self.u_i.z * t37))
                - (((self.u_j.x * t64) + (self.u_j.y * t66)) + (self.u_j.z * t72));
            let t101 = (((self.u_i.x * t39) + (self.u_i.y * t41)) + (self.u_i.z * t43))
                - (((self.u_j.x * t74) + (self.u_j.y * t76)) + (self.u_j.z * t78));
            let t102 = (((2.0 * (t44 * t96)) + (4.0 * ((t9 * t82) + (t0 * t99))))
                + ((2.0 * (t45 * t97)) + (4.0 * ((t10 * t83) + (t1 * t100)))))
                + ((2.0 * (t46 * t98)) + (4.0 * ((t11 * t84) + (t2 * t101))));
            let t103 = (((2.0 * (t89 * t96)) + (4.0 * ((t9 * t92) + (t3 * t99))))
                + ((2.0 * (t90 * t97)) + (4.0 * ((t10 * t93) + (t4 * t100)))))
                + ((2.0 * (t91 * t98)) + (4.0 * ((t11 * t94) + (t5 * t101))));
            q_d[0] = -t88;
            q_d[1] = -t95;
            q_d[2] = -t102;
            q_d[3] = -t103;
        }
        fn parameters(&self, visit: &mut dyn FnMut(&str, f64)) {
            ::kin::rt::Numbers::visit(&self.u_i, "u_i", visit);
            ::kin::rt::Numbers::visit(&self.u_j, "u_j", visit);
            ::kin::rt::Numbers::visit(&self.f_i, "f_i", visit);
            ::kin::rt::Numbers::visit(&self.g_i, "g_i", visit);
            ::kin::rt::Numbers::visit(&self.h_j, "h_j", visit);
        }
        fn set_parameter(&mut self, name: &str, value: f64) -> bool {
            false || ::kin::rt::Numbers::set(&mut self.u_i, "u_i", name, value)
                || ::kin::rt::Numbers::set(&mut self.u_j, "u_j", name, value)
                || ::kin::rt::Numbers::set(&mut self.f_i, "f_i", name, value)
                || ::kin::rt::Numbers::set(&mut self.g_i, "g_i", name, value)
                || ::kin::rt::Numbers::set(&mut self.h_j, "h_j", name, value)
        }
    }
    impl ::kin::rt::Equation<14usize, 4usize> for cylindrical {
        const ARGUMENTS: &'static [::kin::rt::ArgumentKind] = &[
            ::kin::rt::ArgumentKind::Spatial,
            ::kin::rt::ArgumentKind::Spatial,
        ];
        fn evaluate<__D: ::kin::rt::Dual>(
            &self,
            q: &[::kin::rt::Real<__D>; 14usize],
            t: ::kin::rt::Real<__D>,
        ) -> [::kin::rt::Real<__D>; 4usize] {
            let i = ::kin::rt::SpatialState::<
                ::kin::rt::Real<__D>,
            >::new([q[0], q[1], q[2], q[3], q[4], q[5], q[6]]);
            let j = ::kin::rt::SpatialState::<
                ::kin::rt::Real<__D>,
            >::new([q[7], q[8], q[9], q[10], q[11], q[12], q[13]]);
            let u_i = ::kin::rt::Lift::<__D>::lift(self.u_i.clone());
            let u_j = ::kin::rt::Lift::<__D>::lift(self.u_j.clone());
            let f_i = ::kin::rt::Lift::<__D>::lift(self.f_i.clone());
            let g_i = ::kin::rt::Lift::<__D>::lift(self.g_i.clone());
            let h_j = ::kin::rt::Lift::<__D>::lift(self.h_j.clone());
            let value = (move || -> (
                ::kin::rt::Real<__D>,
                ::kin::rt::Real<__D>,
                ::kin::rt::Real<__D>,
                ::kin::rt::Real<__D>,
            ) {
                let (f, g, h) = (i.direction(f_i), i.direction(g_i), j.direction(h_j));
                let d = i.point(u_i) - j.point(u_j);
                (f.dot(h), g.dot(h), f.dot(d), g.dot(d))
            })();
            ::kin::rt::rows(value)
        }
        #[inline]
        fn plain(&self, q: &[f64; 14usize], t: f64) -> [f64; 4usize] {
            let i = ::kin::rt::SpatialState::<
                f64,
            >::new([q[0], q[1], q[2], q[3], q[4], q[5], q[6]]);
            let j = ::kin::rt::SpatialState::<
                f64,
            >::new([q[7], q[8], q[9], q[10], q[11], q[12], q[13]]);
            let u_i: Vec3 = self.u_i.clone();
            let u_j: Vec3 = self.u_j.clone();
            let f_i: Vec3 = self.f_i.clone();
            let g_i: Vec3 = self.g_i.clone();
            let h_j: Vec3 = self.h_j.clone();
            let value = (move || -> (f64, f64, f64, f64) {
                let (f, g, h) = (i.direction(f_i), i.direction(g_i), j.direction(h_j));
                let d = i.point(u_i) - j.point(u_j);
                (f.dot(h), g.dot(h), f.dot(d), g.dot(d))
            })();
            ::kin::rt::rows(value)
        }
    }
};
