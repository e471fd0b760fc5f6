# SPDX-License-Identifier: BSD-3-Clause
"""Radiance's rtrace sees a sphere of our materials as their formula says."""

import math
import pathlib
import random
import subprocess

import interop

PAIRS = 60
SUN = "void light sun\n0\n0\n3 1000 1000 1000\nsun source star\n0\n0\n4 {} {} {} 0.5\n"
WHITE = "void plastic material\n0\n0\n5 1 1 1 0 0\n"
BALL = "material sphere ball\n0\n0\n4 0 0 0 1\n"


class RadianceParameters(interop.TestCase):
    def program(self, name):
        package = interop.module("pyradiance")
        path = pathlib.Path(package.__file__).parent / "bin" / name
        return path if path.is_file() else interop.missing(f"the program {name}")

    def radiance(self, material, light, viewer):
        """Radiance of the top of the sphere, in red, green and blue."""
        scene, octree = self.folder / "scene.rad", self.folder / "scene.oct"
        scene.write_text(material + SUN.format(*light) + BALL)
        octree.write_bytes(self.compiled(scene))
        start = " ".join(repr(float(v)) for v in (2 * viewer[0], 2 * viewer[1], 1 + 2 * viewer[2], -viewer[0], -viewer[1], -viewer[2]))
        # Direct light alone, without jitter, at the full precision of text.
        flags = ["-h", "-ab", "0", "-dj", "0", "-dt", "0", "-dc", "1", "-lr", "0", "-av", "0", "0", "0", "-faa"]
        out = interop.run(self.program("rtrace"), *flags, octree, stdin=start + "\n")
        return [float(v) for v in out.split()[:3]]

    def compiled(self, scene):
        return subprocess.run([str(self.program("oconv")), str(scene)], capture_output=True, check=True).stdout

    def directions(self):
        choice = random.Random(20260701)
        for _ in range(PAIRS):
            out = []
            for _ in range(2):
                theta, phi = math.acos(choice.uniform(0.2, 1)), choice.uniform(-math.pi, math.pi)
                out.append((math.sin(theta) * math.cos(phi), math.sin(theta) * math.sin(phi), math.cos(theta)))
            yield out

    @staticmethod
    def angles(v):
        return math.degrees(math.atan2(math.hypot(v[0], v[1]), v[2])), math.degrees(math.atan2(v[1], v[0]))

    def check_against(self, target, model, **parameters):
        # Ward's lobe is what these materials have: the fit goes in unchanged, and rtrace is held against the fit itself.
        fit = self.fit(model, **parameters)
        out = self.folder / "material.rad"
        interop.gonio("export", fit, "--to", target, "--out", out)
        worst = 0
        pairs = list(self.directions())
        values = interop.evaluate(fit, [(*self.angles(light), *self.angles(viewer)) for light, viewer in pairs])
        for (light, viewer), (value,) in zip(pairs, values):
            white = self.radiance(WHITE, light, viewer)
            found = self.radiance(out.read_text(), light, viewer)
            worst = max(worst, max(abs(found[c] / white[c] / math.pi - value) / value for c in range(3)))
        # Six digits of rtrace's text, the single precision of its colours, and the size of the sun.
        self.check(worst < 2e-3, f"{target}: largest relative difference {worst!r}")

    def test_wgmdfunc(self):
        self.check_against("radiance", "ward-duer-gm", rho_d=0.2, rho_s=0.1, alpha=0.2)

    def test_wgmdfunc_with_two_widths(self):
        self.check_against("radiance", "ward-duer-gm-anisotropic", rho_d=0.2, rho_s=0.1, alpha_x=0.12, alpha_y=0.3)

    def test_plastic2(self):
        self.check_against("radiance-plastic", "ward-duer-gm-anisotropic", rho_d=0.2, rho_s=0.1, alpha_x=0.3, alpha_y=0.12)

    def test_plastic(self):
        self.check_against("radiance-plastic", "ward-duer-gm", rho_d=0.3, rho_s=0.05, alpha=0.15)

    def test_the_scene_beside_the_material_is_rendered(self):
        fit = self.fit("ward-duer-gm", rho_d=0.3, rho_s=0.05, alpha=0.15)
        for target in ("radiance", "radiance-plastic"):
            interop.gonio("export", fit, "--to", target, "--out", self.folder / f"{target}.rad", "--scene")
            octree = self.folder / "scene.oct"
            octree.write_bytes(self.compiled(self.folder / f"{target}.scene.rad"))
            # From the camera past the ball, at its middle, and at its highlight.
            rays = "0 -5 0 0.3 1 0\n0 -5 0 0 1 0\n0 -5 0 -0.045 1 0.08\n"
            out = interop.run(self.program("rtrace"), "-h", "-ab", "1", "-faa", octree, stdin=rays)
            sky, middle, highlight = (float(line.split()[1]) for line in out.splitlines() if line.strip())
            self.check(abs(sky - 0.2) < 1e-6, f"{target}: a sky of {sky}")
            self.check(0.05 < middle < highlight, f"{target}: {middle} in the middle, {highlight} in the highlight")


interop.main()
