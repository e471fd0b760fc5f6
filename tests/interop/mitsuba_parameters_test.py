# SPDX-License-Identifier: BSD-3-Clause
"""Mitsuba 3 evaluates the materials of our scenes as their formula says."""

import math
import re

import interop

PAIRS = 1000


class MitsubaParameters(interop.TestCase):
    def setUp(self):
        super().setUp()
        self.mitsuba = interop.module("mitsuba")
        self.numpy = interop.module("numpy")
        self.mitsuba.set_variant("scalar_rgb")

    def directions(self):
        random = self.numpy.random.default_rng(20260701)
        out = []
        for _ in range(PAIRS):
            z = random.uniform(0.05, 1, 2)
            phi = random.uniform(-math.pi, math.pi, 2)
            r = self.numpy.sqrt(1 - z * z)
            out.append([(r[k] * math.cos(phi[k]), r[k] * math.sin(phi[k]), z[k]) for k in (0, 1)])
        return out

    def evaluated(self, scene, pairs):
        """f [1/sr] per pair and channel, cosine taken out again, as Mitsuba's own material gives it."""
        loaded = self.mitsuba.load_file(str(scene))
        bsdf = loaded.shapes()[0].bsdf()
        context = self.mitsuba.BSDFContext()
        out = []
        for light, viewer in pairs:
            at = self.mitsuba.SurfaceInteraction3f()
            at.wi = viewer
            value = bsdf.eval(context, at, light)
            out.append([value[c] / light[2] for c in range(3)])
        return out

    def agree(self, found, wanted, tolerance, what):
        """All values within `tolerance` of the wanted one, relative to it or to 1e-3 where it is darker."""
        worst = max(abs(a - b) / max(abs(b), 1e-3) for x, y in zip(found, wanted) for a, b in zip(x, y))
        self.check(worst <= tolerance, f"{what}: largest relative difference {worst!r}, wanted {tolerance!r}")

    def degrees(self, pairs):
        def angles(v):
            return math.degrees(math.atan2(math.hypot(v[0], v[1]), v[2])), math.degrees(math.atan2(v[1], v[0]))

        return [(*angles(light), *angles(viewer)) for light, viewer in pairs]

    def values(self, scene):
        """Named numbers of the material in a scene."""
        text = scene.read_text()
        text = text[text.index('id="material"') : text.index("<shape")]
        return {name: [float(v) for v in value.split(",")] for name, value in re.findall(r'<(?:float|rgb) name="(\w+)" value="([^"]+)"', text)}

    def test_a_model_it_can_express_exactly(self):
        # ρd/π plus a separable GGX lobe of a dielectric that reflects a part of what Fresnel says: blendbsdf has just that.
        fit = self.fit("ggx-separable-fresnel", rho_d=0.3, rho_s=0.6, alpha=0.25, n=1.7)
        scene = self.folder / "scene.xml"
        interop.gonio("export", fit, "--to", "mitsuba", "--out", scene)
        pairs = self.directions()
        ours = [[value[0]] * 3 for value in interop.evaluate(fit, self.degrees(pairs))]
        # Single precision of Mitsuba at the peak of the lobe.
        self.agree(self.evaluated(scene, pairs), ours, 2e-4, "blendbsdf against the fit it came from")

    def lobe(self, light, viewer, alpha):
        half = [a + b for a, b in zip(light, viewer)]
        length = math.sqrt(sum(v * v for v in half))
        tan2 = (half[0] ** 2 + half[1] ** 2) / half[2] ** 2
        cos4 = (half[2] / length) ** 4
        d = alpha**2 / (math.pi * cos4 * (alpha**2 + tan2) ** 2)
        g = 1.0
        for w in (light, viewer):
            g *= 2 / (1 + math.sqrt(1 + alpha**2 * (1 / w[2] ** 2 - 1)))
        return d * g / (4 * light[2] * viewer[2]), length / 2

    @staticmethod
    def fresnel(c, n):
        t = math.sqrt(1 - (1 - c * c) / n**2)
        return (((c - n * t) / (c + n * t)) ** 2 + ((n * c - t) / (n * c + t)) ** 2) / 2

    def scene_of(self, wanted, fit):
        scene = self.folder / "scene.xml"
        interop.gonio("export", fit, "--to", "mitsuba", "--out", scene)
        self.check(f'type="{wanted}" id="material"' in scene.read_text(), f"{wanted} is the material that comes nearest")
        return scene

    def test_principled(self):
        scene = self.scene_of("principled", self.fit("ggx", rho_d=0.2, f0=0.04, f90=1, alpha=0.2))
        v = {name: value[0] for name, value in self.values(scene).items()}
        pairs, wanted = self.directions(), []
        for light, viewer in pairs:
            lobe, c = self.lobe(light, viewer, v["roughness"] ** 2)
            m, base = v["metallic"], v["base_color"]
            weight = [(1 - x) ** 5 for x in (c, light[2], viewer[2])]
            r = 2 * v["roughness"] * c * c
            diffuse = (1 + (r - 0.5) * weight[1]) * (1 + (r - 0.5) * weight[2]) * base / math.pi
            f = (1 - m) * diffuse + lobe * ((1 - m) * self.fresnel(c, v["eta"]) + m * (base + (1 - base) * weight[0]))
            wanted.append([f] * 3)
        self.agree(self.evaluated(scene, pairs), wanted, 2e-4, "principled")

    def parts(self, cosines, alpha, n):
        """Means over the normals seen from each cosine: reflected up and transmitted down, single scattering (64 cosines at once)."""
        np = self.numpy
        c0 = cosines[:, None, None]
        s0 = np.sqrt(1 - c0 * c0)
        length = np.hypot(alpha * s0, c0)
        vx, vz = alpha * s0 / length, c0 / length
        count = 160
        u = ((np.arange(count) + 0.5) / count)[None, :, None]
        phi = math.pi * ((np.arange(count) + 0.5) / count)[None, None, :]
        z = (1 - u) * (1 + vz) - vz
        r = np.sqrt(np.maximum(0, 1 - z * z))
        mx, my, mz = alpha * (r * np.cos(phi) + vx), alpha * r * np.sin(phi), z + vz
        norm = np.sqrt(mx**2 + my**2 + mz**2)
        mx, mz = mx / norm, mz / norm
        c = np.maximum(s0 * mx + c0 * mz, 1e-12)
        sin2 = (1 - c * c) / n**2
        inside = sin2 < 1
        t = np.sqrt(np.where(inside, 1 - sin2, 0))
        f = np.where(inside, (((c - n * t) / (c + n * t)) ** 2 + ((n * c - t) / (n * c + t)) ** 2) / 2, 1)

        def g1(cosine):
            k = np.maximum(cosine, 1e-12)
            return np.where(cosine > 0, 2 / (1 + np.sqrt(1 + alpha**2 * (1 / k**2 - 1))), 0)

        return (f * g1(2 * c * mz - c0)).mean((1, 2)), ((1 - f) * g1(-((c / n - t) * mz - c0 / n))).mean((1, 2))

    def test_roughplastic(self):
        np = self.numpy
        scene = self.scene_of("roughplastic", self.fit("ward-duer-gm", rho_d=0.2, rho_s=0.1, alpha=0.2))
        v = {name: value[0] for name, value in self.values(scene).items()}
        nodes = np.maximum(1e-6, np.linspace(0, 1, 64))
        through = self.parts(nodes, v["alpha"], v["int_ior"])[1]
        back = 2 * (self.parts(nodes, v["alpha"], 1 / v["int_ior"])[0] * nodes).mean()
        a = v["diffuse_reflectance"]
        pairs, wanted = self.directions(), []
        for light, viewer in pairs:
            lobe, c = self.lobe(light, viewer, v["alpha"])
            t = np.interp([light[2], viewer[2]], np.linspace(0, 1, 64), through)
            diffuse = a / (1 - a * back) * t[0] * t[1] / (math.pi * v["int_ior"] ** 2)
            wanted.append([v["specular_reflectance"] * self.fresnel(c, v["int_ior"]) * lobe + diffuse] * 3)
        # Of the quadrature at the edge of total reflection, theirs and ours.
        self.agree(self.evaluated(scene, pairs), wanted, 3e-3, "roughplastic")
        printed = interop.gonio("export", self.folder / "ward-duer-gm.fit.json", "--to", "mitsuba", "--out", self.folder / "again.xml")
        self.check("after the refit" in printed and "naive conversion" in printed, "errors are printed")

    def test_two_widths(self):
        # Isotropic formulas are a special case of these; here the axes are told apart.
        rows = ["theta_i_deg,phi_i_deg,theta_o_deg,phi_o_deg,value"]
        pairs = [(i, p, o, q) for i in range(0, 70, 20) for p in range(0, 180, 30) for o in range(0, 80, 8) for q in range(0, 360, 30)]
        given = ("--param", "rho_d=0.1", "--param", "rho_s=0.3", "--param", "alpha_x=0.15", "--param", "alpha_y=0.35")
        for pair, value in zip(pairs, interop.evaluate("ward-duer-gm-anisotropic", pairs, *given)):
            rows.append(",".join(map(repr, [*pair, *value])))
        samples, scene = self.folder / "samples.csv", self.folder / "scene.xml"
        samples.write_text("\n".join(rows) + "\n")
        interop.gonio("export", samples, "--to", "mitsuba", "--out", scene)
        v = {name: value[0] for name, value in self.values(scene).items()}
        self.check(2 * v["alpha_u"] < v["alpha_v"], f"a lobe wider along y: {v}")
        along = self.evaluated(scene, [((0.5, 0, 0.75**0.5), (0, 0, 1))])[0][0]
        across = self.evaluated(scene, [((0, 0.5, 0.75**0.5), (0, 0, 1))])[0][0]
        self.check(across > 1.5 * along, f"a half vector along y is nearer to the lobe: {across!r} against {along!r}")

    def test_the_scene_renders(self):
        scene = self.folder / "scene.xml"
        interop.gonio("export", self.fit("ggx", rho_d=0.2, f0=0.04, f90=1, alpha=0.2), "--to", "mitsuba", "--out", scene)
        loaded = self.mitsuba.load_file(str(scene))
        picture = self.numpy.array(self.mitsuba.render(loaded, spp=1))
        self.check(picture.shape == (512, 512, 3) and picture.min() >= 0, "a picture of the scene's size")
        self.check(0.1 < picture[246:266, 246:266].mean() < 10, f"a lit sphere in its middle: {picture[246:266, 246:266].mean()}")

    def test_the_printed_error_is_that_of_the_real_program(self):
        # The share of pairs differs from the grid of the refit; the figure is of the same size.
        fit = self.fit("ward-duer-gm", rho_d=0.2, rho_s=0.1, alpha=0.2)
        scene = self.folder / "scene.xml"
        notes = interop.load_json(interop.gonio("export", fit, "--to", "mitsuba", "--out", scene, "--json"))["notes"]
        printed = float(re.search(r"mean relative ([0-9.]+) %", notes["facts"]["after the refit"]).group(1)) / 100
        pairs = [p for p in self.directions() if min(p[0][2], p[1][2]) > math.cos(math.radians(80))]
        weight = [light[2] * viewer[2] for light, viewer in pairs]
        ours = interop.evaluate(fit, self.degrees(pairs))
        theirs = self.evaluated(scene, pairs)
        error = sum(w * abs(a[0] - b[0]) / b[0] for w, a, b in zip(weight, theirs, ours)) / sum(weight)
        self.check(0.7 * printed <= error <= 1.4 * printed, f"mean relative error of Mitsuba's material {error!r}, printed {printed!r}")


interop.main()
