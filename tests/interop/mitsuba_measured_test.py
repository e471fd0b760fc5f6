# SPDX-License-Identifier: BSD-3-Clause
"""Mitsuba 3 loads our material files, evaluates them as we do and renders the scenes beside them."""

import math
import re

import interop

PAIRS = 1000
WIDEST_DEG = 80
# Both read the same float arrays; Mitsuba evaluates in float, which a density that falls by orders of magnitude within a cell feels.
MEAN_AGREEMENT = 1e-4
WORST_AGREEMENT = 5e-3


class MitsubaMeasured(interop.TestCase):
    def setUp(self):
        super().setUp()
        self.mitsuba = interop.module("mitsuba")
        self.numpy = interop.module("numpy")
        self.mitsuba.set_variant("scalar_rgb")

    def pairs(self):
        """Directions wi and wo, uniform in solid angle within 80 degrees, as angles in degrees."""
        random = self.numpy.random.default_rng(20260701)
        z = random.uniform(math.cos(math.radians(WIDEST_DEG)), 1, (PAIRS, 2))
        theta = self.numpy.degrees(self.numpy.arccos(z))
        phi = random.uniform(-180, 180, (PAIRS, 2))
        return [(theta[k, 0], phi[k, 0], theta[k, 1], phi[k, 1]) for k in range(PAIRS)]

    def export(self, source, target, size="standard"):
        path = self.folder / f"{target}-{size}.bsdf"
        interop.gonio("export", source, "--to", target, "--size", size, "--scene", "--out", path)
        return path

    def evaluated(self, path, pairs, variant="scalar_rgb", wavelengths=None):
        """f [1/sr] of each pair as Mitsuba gives it, without its cosine. Its wi is the direction that the table is made for: our wi."""
        mi = self.mitsuba
        mi.set_variant(variant)
        bsdf = mi.load_dict({"type": "measured", "filename": str(path)})
        context, out = mi.BSDFContext(), []
        for theta_i, phi_i, theta_o, phi_o in pairs:

            def direction(theta, phi):
                t, p = math.radians(theta), math.radians(phi)
                return [math.sin(t) * math.cos(p), math.sin(t) * math.sin(p), math.cos(t)]

            at = mi.SurfaceInteraction3f()
            at.wi = direction(theta_i, phi_i)
            if wavelengths:
                at.wavelengths = wavelengths
            value = bsdf.eval(context, at, direction(theta_o, phi_o))
            out.append([value[c] / math.cos(math.radians(theta_o)) for c in range(len(wavelengths or "rgb"))])
        mi.set_variant("scalar_rgb")
        return self.numpy.array(out)

    def agree(self, theirs, ours, what):
        ours = self.numpy.array(ours)
        error = abs(theirs - ours) / abs(ours)
        print(f"{what}: mean {error.mean():.2e}, worst {error.max():.2e}")
        self.check(error.mean() <= MEAN_AGREEMENT, f"{what}: mean relative difference {error.mean()!r}")
        self.check(error.max() <= WORST_AGREEMENT, f"{what}: largest relative difference {error.max()!r}")

    def close_to_source(self, theirs, source, pairs, tolerance, what):
        wanted = self.numpy.array(source)
        error = (abs(theirs - wanted) / wanted).mean()
        print(f"{what}: mean {error:.2e} of the source")
        self.check(error <= tolerance, f"{what}: mean relative error {error!r} against the source, wanted {tolerance!r}")

    def test_rgb_files_of_models(self):
        pairs = self.pairs()
        for alpha, size, tolerance in ((0.1, "standard", 0.01), (0.3, "standard", 0.01), (0.1, "fine", 0.003)):
            fit = self.fit("ggx", rho_d=0, f0=0.9, f90=1, alpha=alpha)
            path = self.export(fit, "rgl", size)
            theirs = self.evaluated(path, pairs)
            self.agree(theirs, interop.evaluate(path, pairs), f"GGX {alpha}, {size}")
            self.close_to_source(theirs, interop.evaluate(fit, pairs), pairs, tolerance, f"GGX {alpha}, {size}")

    def test_an_anisotropic_file(self):
        pairs = self.pairs()
        fit = self.anisotropic_fit()
        path = self.export(fit, "rgl")
        theirs = self.evaluated(path, pairs)
        self.agree(theirs, interop.evaluate(path, pairs), "Ward 0.15 x 0.4")
        self.close_to_source(theirs, interop.evaluate(fit, pairs), pairs, 0.01, "Ward 0.15 x 0.4")

    def anisotropic_fit(self):
        rows = ["theta_i_deg,phi_i_deg,theta_o_deg,phi_o_deg,value"]
        pairs = [(i, j, o, p) for i in range(0, 80, 20) for j in range(0, 180, 30) for o in range(0, 81, 8) for p in range(0, 360, 20)]
        given = [part for text in ("rho_d=0.2", "rho_s=0.4", "alpha_x=0.15", "alpha_y=0.4") for part in ("--param", text)]
        for pair, value in zip(pairs, interop.evaluate("ward-duer-gm-anisotropic", pairs, *given)):
            rows.append(",".join(map(repr, [*pair, *value])))
        samples = self.folder / "anisotropic.csv"
        samples.write_text("\n".join(rows) + "\n")
        out = self.folder / "anisotropic.fit.json"
        interop.gonio("fit", samples, "--model", "ward-duer-gm-anisotropic", "--out", out)
        return out

    def test_spectral_files(self):
        pairs = self.pairs()
        fit = self.fit("ggx", rho_d=0.2, f0=0.5, f90=1, alpha=0.2)
        rgb = self.export(fit, "rgl")
        spectral = self.folder / "spectral.bsdf"
        interop.gonio("export", rgb, "--to", "rgl-spectral", "--out", spectral)
        shown = [400.0, 490.0, 550.0, 700.0]
        theirs = self.evaluated(spectral, pairs, "scalar_spectral", shown)
        ours = self.numpy.array(interop.evaluate(spectral, pairs))
        self.check(ours.shape[1] == 48, "48 wavelengths")
        self.agree(theirs, ours[:, [int(nm - 360) // 10 for nm in shown]], "spectral GGX")
        with self.assertRaises(RuntimeError):
            self.evaluated(spectral, pairs[:1])  # an RGB mode does not take spectra
        interop.TestCase.checks += 1

    def rendered(self, text, variant):
        """Mean of the image of a scene, on fewer pixels."""
        mi = self.mitsuba
        mi.set_variant(variant)
        text = re.sub(r'"(width|height)" value="512"', r'"\1" value="48"', text)
        text = re.sub(r'"sample_count" value="64"', '"sample_count" value="256"', text)
        scene = self.folder / "rendered.xml"
        scene.write_text(text)
        image = self.numpy.array(mi.render(mi.load_file(str(scene)), seed=1))
        mi.set_variant("scalar_rgb")
        self.check(self.numpy.isfinite(image).all(), "every pixel is finite")
        return image[..., :3].mean((0, 1))

    def test_a_matt_sphere_is_rendered_as_bright_as_a_diffuse_one(self):
        fit = self.fit("lambert", rho_d=0.5)
        diffuse = '<bsdf type="diffuse" id="material"><rgb name="reflectance" value="0.5"/></bsdf>'
        for target, variant in (("rgl", "scalar_rgb"), ("rgl-spectral", "scalar_spectral")):
            text = self.export(fit, target).with_suffix(".xml").read_text()
            found = self.rendered(text, variant)
            wanted = self.rendered(re.sub(r"<bsdf.*</bsdf>", diffuse, text, flags=re.S), variant)
            print(f"{variant}: measured {found}, diffuse {wanted}")
            for c in range(3):
                self.near(found[c] / wanted[c], 1, 0.001, f"{variant}, channel {c}")

    def test_the_scene_of_a_glossy_material_is_rendered(self):
        fit = self.fit("ggx", rho_d=0.1, f0=0.6, f90=1, alpha=0.2)
        mean = self.rendered(self.export(fit, "rgl", "paper").with_suffix(".xml").read_text(), "scalar_rgb")
        self.check((mean > 0.01).all(), f"the sphere is seen: {mean}")


interop.main()
