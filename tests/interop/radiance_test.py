# SPDX-License-Identifier: BSD-3-Clause
"""Radiance reads the XML gonio writes: its library gives our patch means, its checker our reciprocity, its renderer our radiance."""

import math
import os
import pathlib
import random
import re
import subprocess
import sys

import interop

# Radiance shakes every value by up to 3e-4 of it (matrices) or 2e-4 (trees), so that equal values of neighbours can be told apart.
SHAKEN = 5e-4
# Values as small as this vanish in the Lambertian part that Radiance splits off in single precision.
TINY = 1e-6

# One process per file: loading several in one of pyradiance's library ends in a crash of its own.
QUERY = """
import sys
from pyradiance import bsdf
loaded = bsdf.load_file(sys.argv[1])
for line in sys.stdin:
    print(*(float(value) for value in bsdf.query(loaded, *map(float, line.split()))))
"""

MATRICES = ("radiance-klems-full", "radiance-klems-half", "radiance-klems-quarter")
TREES = ("radiance-tree3", "radiance-tree4")


class Radiance(interop.TestCase):
    def setUp(self):
        super().setUp()
        interop.module("pyradiance.bsdf")
        self.package = pathlib.Path(interop.module("pyradiance").__file__).parent
        os.environ["RAYPATH"] = f".:{self.package / 'lib'}"

    def program(self, name):
        return interop.program(str(self.package / "bin" / name))

    def query(self, xml, pairs):
        """X, Y, Z that Radiance's library gives at directions theta_i, phi_i, theta_o, phi_o in degrees; above 90 is the back."""
        lines = "".join("{!r} {!r} {!r} {!r}\n".format(*map(float, pair)) for pair in pairs)
        out = interop.run(sys.executable, "-c", QUERY, xml, stdin=lines)
        return [[float(value) for value in line.split()] for line in out.splitlines()]

    def pairs(self, count, limit=85):
        draw = random.Random(20260802)
        low = math.cos(math.radians(limit))
        theta = lambda: math.degrees(math.acos(draw.uniform(low, 1)))
        phi = lambda: draw.uniform(-180, 180)
        return [(theta(), phi(), theta(), phi()) for _ in range(count)]

    def xml(self, source, target):
        out = self.folder / f"{target}.xml"
        interop.gonio("export", source, "--to", target, "--size", "paper", "--out", out)
        return out

    def agree(self, xml, pairs, front=False):
        """Radiance's values against those of gonio's own reading of the file, at the same directions."""
        mirrored = [(i, -p, o, -q) for i, p, o, q in pairs] if front else pairs
        seen = [(180 - i, p, 180 - o, q) for i, p, o, q in pairs] if front else pairs
        ours = interop.evaluate(xml, mirrored, "--assume", f"side={'front' if front else 'back'}")
        worst = 0
        for theirs, value in zip(self.query(xml, seen), ours):
            luminance = value[0] if len(value) == 1 else 0.265 * value[0] + 0.670 * value[1] + 0.065 * value[2]
            worst = max(worst, abs(theirs[1] - luminance) / (luminance + TINY))
        return worst

    def test_isotropic_values_are_ours(self):
        source = self.fit("ggx", rho_d=0.2, f0=0.5, f90=0.9, alpha=0.2)
        for target in MATRICES + TREES:
            worst = self.agree(self.xml(source, target), self.pairs(2000))
            self.check(worst <= SHAKEN, f"{target}: largest relative difference {worst}")

    def test_anisotropic_values_are_ours_on_both_sides(self):
        source = self.fit("ward-anisotropic", rho_d=0.1, rho_s=0.2, alpha_x=0.15, alpha_y=0.4)
        for target in ("radiance-klems-full", "radiance-tree4"):
            xml = self.xml(source, target)
            for front in (False, True):
                worst = self.agree(xml, self.pairs(2000), front)
                self.check(worst <= SHAKEN, f"{target}, front {front}: largest relative difference {worst}")

    def test_a_wrong_side_would_be_seen(self):
        source = self.fit("ward-anisotropic", rho_d=0.1, rho_s=0.2, alpha_x=0.15, alpha_y=0.4)
        xml = self.xml(source, "radiance-klems-full")
        turned = [(i, p + 40, o, q + 40) for i, p, o, q in self.pairs(500)]
        ours = interop.evaluate(xml, self.pairs(500))
        worst = max(abs(theirs[1] / value[0] - 1) for theirs, value in zip(self.query(xml, turned), ours))
        self.check(worst > 0.05, "turning the surface changes what Radiance gives")

    def test_patch_means_are_those_of_the_model(self):
        """The value of a pair of patches against the mean of the model over it, by brute force."""
        source = self.fit("ggx", rho_d=0.2, f0=0.5, f90=0.9, alpha=0.2)
        xml = self.xml(source, "radiance-klems-full")
        draw = random.Random(7)

        def inside(low, high, phi, width):
            sine2 = draw.uniform(math.sin(math.radians(low)) ** 2, math.sin(math.radians(high)) ** 2)
            return math.degrees(math.asin(math.sqrt(sine2))), phi + draw.uniform(-0.5, 0.5) * width

        for light, view in (((25, 35, 0, 18), (25, 35, 180, 18)), ((25, 35, 0, 18), (35, 45, 90, 15)), ((45, 55, 30, 15), (65, 75, 225, 22.5))):
            pairs = [inside(*light) + inside(*view) for _ in range(40000)]
            values = [value[0] for value in interop.evaluate(source, pairs)]
            mean = sum(values) / len(values)
            spread = math.sqrt(sum((value - mean) ** 2 for value in values)) / len(values)
            theirs = self.query(xml, [(0.5 * (light[0] + light[1]), light[2], 0.5 * (view[0] + view[1]), view[2])])[0][1]
            self.near(theirs, mean, 4 * spread + SHAKEN * mean, f"mean over {light} x {view}")

    def test_colours_are_ours(self):
        # Radiance stores chromaticities in few bits: the hue is checked coarsely, the luminance as above.
        rows = ["# gonio samples 1", "# symmetry: isotropic", "# channel.1: r", "# channel.2: g", "# channel.3: b", "theta_i_deg,phi_i_deg,theta_o_deg,phi_o_deg,r,g,b"]
        rows += [f"{i},0,{o},{p},0.3,0.2,0.1" for i in range(0, 90, 10) for o in range(0, 90, 10) for p in range(0, 360, 30)]
        samples = self.folder / "orange.csv"
        samples.write_text("\n".join(rows) + "\n")
        for target in ("radiance-klems-quarter", "radiance-tree4"):
            xml = self.xml(samples, target)
            worst = self.agree(xml, self.pairs(300, 70))
            self.check(worst <= SHAKEN, f"{target}: largest relative difference of the luminance {worst}")
            x, y, z = self.query(xml, [(30, 0, 40, 90)])[0]
            self.near(x / y, (0.640 / 0.330 * 0.265 * 0.3 + 0.290 / 0.600 * 0.670 * 0.2 + 0.150 / 0.060 * 0.065 * 0.1) / y, 0.02, f"X/Y, {target}")
            self.near(z / y, (0.03 / 0.330 * 0.265 * 0.3 + 0.11 / 0.600 * 0.670 * 0.2 + 0.79 / 0.060 * 0.065 * 0.1) / y, 0.02, f"Z/Y, {target}")

    def test_its_own_check_finds_our_reciprocity(self):
        source = self.fit("ggx", rho_d=0.2, f0=0.5, f90=0.9, alpha=0.2)
        for target, average, largest in (("radiance-klems-full", 0.05, 1), ("radiance-klems-quarter", 0.1, 3), ("radiance-tree4", 0.05, 1)):
            report = interop.run(self.program("checkBSDF"), self.xml(source, target))
            errors = report.split("Reciprocity Error")[1]
            found = re.search(r"Exterior Refl\s+(\S+)\s+(\S+)\s+(\S+)", errors)
            self.check(found and float(found[2]) <= average and float(found[3]) <= largest, f"{target}: {report}")

    def test_the_scene_beside_the_file_renders(self):
        source = self.fit("ggx", rho_d=0.2, f0=0.5, f90=0.9, alpha=0.2)
        interop.gonio("export", source, "--to", "radiance-klems-quarter", "--scene", "--out", self.folder / "metal.xml")
        octree = self.folder / "metal.oct"
        octree.write_bytes(subprocess.run([self.program("oconv"), "metal.rad"], cwd=self.folder, capture_output=True, check=True).stdout)
        view = "-vp 0 -4 0 -vd 0 1 0 -vu 0 0 1 -vh 35 -vv 35 -ab 1 -ss 4 -x 32 -y 32".split()
        picture = subprocess.run([self.program("rpict"), *view, octree], cwd=self.folder, capture_output=True)
        self.check(picture.returncode == 0, f"rpict: {picture.stderr}")
        values = subprocess.run([self.program("pvalue"), "-o", "-h", "-H", "-d", "-b"], input=picture.stdout, capture_output=True, check=True)
        pixels = [float(line) for line in values.stdout.decode().split()]
        self.check(len(pixels) >= 31 * 31, f"{len(pixels)} pixels")
        middle = pixels[len(pixels) // 2 - 5 : len(pixels) // 2 + 5]
        self.check(min(middle) > 0.01 and max(pixels) < 1e4, f"the sphere is lit: {middle}")

    def test_pab_files_become_a_bsdf_again(self):
        """pabopto2bsdf takes our files; the interpolation it makes of them, as a matrix, is near the model it came from."""
        source = self.fit("ggx", rho_d=0.2, f0=0.5, f90=0.9, alpha=0.3)
        folder = self.folder / "pab"
        folder.mkdir()
        interop.gonio("export", source, "--to", "pab", "--size", "paper", "--out", folder / "m.dat")
        files = sorted(folder.iterdir())
        self.check(len(files) >= 9, f"{len(files)} files, one per incidence")
        sir = self.folder / "m.sir"
        environment = dict(os.environ, PATH=f"{self.package / 'bin'}:{os.environ['PATH']}")
        done = subprocess.run([self.program("pabopto2bsdf"), *files], capture_output=True, env=environment)
        self.check(done.returncode == 0 and not done.stderr, f"pabopto2bsdf: {done.stderr}")
        sir.write_bytes(done.stdout)
        done = subprocess.run([self.program("bsdf2klems"), "-p", "-q", sir], capture_output=True, env=environment)
        xml = self.folder / "m.xml"
        xml.write_bytes(done.stdout)
        ours = self.xml(source, "radiance-klems-quarter")
        pairs = self.pairs(400, 60)
        theirs = [value[0] for value in interop.evaluate(xml, pairs)]
        means = [value[0] for value in interop.evaluate(ours, pairs)]
        error = sum(abs(a / b - 1) for a, b in zip(theirs, means)) / len(pairs)
        # Radial functions fitted to logarithms smooth the lobe; a wrong azimuth or cosine would be far off.
        self.check(error < 0.12, f"mean relative difference {error}")

    def test_a_rendered_sphere_is_as_bright_as_the_brdf_says(self):
        """rtrace looks at the sphere of the scene under one distant lamp: radiance = f · irradiance, f as gonio evaluates the XML."""
        source = self.fit("ggx", rho_d=0.2, f0=0.5, f90=0.9, alpha=0.2)
        for target in ("radiance-klems-full", "radiance-tree3"):
            xml = self.xml(source, target)
            light = (-0.5, -0.7, 0.6)
            size = math.sqrt(sum(c * c for c in light))
            light = [c / size for c in light]
            angle = 0.5
            scene = self.folder / "scene.rad"
            scene.write_text(
                f"void BSDF m\n6 0 {xml.name} 0 0 1 .\n0\n0\nm sphere ball\n0\n0\n4 0 0 0 1\n"
                f"void light lamp\n0\n0\n3 1000 1000 1000\nlamp source sun\n0\n0\n4 {light[0]} {light[1]} {light[2]} {angle}\n"
            )
            octree = self.folder / "scene.oct"
            here = os.getcwd()
            os.chdir(self.folder)
            self.addCleanup(os.chdir, here)
            octree.write_bytes(subprocess.run([self.program("oconv"), scene], capture_output=True, check=True).stdout)
            irradiance_facing = 1000 * math.pi * math.sin(math.radians(angle / 2)) ** 2
            rays, pairs, cosines = [], [], []
            draw = random.Random(3)
            while len(rays) < 200:
                x, z = draw.uniform(-0.9, 0.9), draw.uniform(-0.9, 0.9)
                if x * x + z * z > 0.8:
                    continue
                n = (x, -math.sqrt(1 - x * x - z * z), z)
                cosine = sum(a * b for a, b in zip(n, light))
                if cosine < 0.2:
                    continue
                # The view is along +y; an isotropic surface needs only the angles and the difference of azimuths.
                view = (0, -1, 0)
                cos_o = -n[1]
                li = [l - cosine * c for l, c in zip(light, n)]
                vo = [v - cos_o * c for v, c in zip(view, n)]
                cross = sum(c * (li[(k + 1) % 3] * vo[(k + 2) % 3] - li[(k + 2) % 3] * vo[(k + 1) % 3]) for k, c in enumerate(n))
                phi = math.degrees(math.atan2(cross, sum(a * b for a, b in zip(li, vo))))
                rays.append(f"{x} -5 {z} 0 1 0")
                pairs.append((math.degrees(math.acos(cosine)), 0, math.degrees(math.acos(cos_o)), phi))
                cosines.append(cosine)
            traced = interop.run(self.program("rtrace"), "-h", "-ab", "0", "-dj", "0", "-ov", octree, stdin="\n".join(rays) + "\n")
            radiance = [float(line.split()[1]) for line in traced.splitlines()]
            values = [value[0] for value in interop.evaluate(xml, pairs)]
            ratios = [r / (f * irradiance_facing * c) for r, f, c in zip(radiance, values, cosines)]
            # Patches are turned with the surface, so single values differ where patches end; their mean does not.
            mean = sum(ratios) / len(ratios)
            self.near(mean, 1, 0.03, f"{target}: mean of rendered over predicted radiance")


if __name__ == "__main__":
    interop.main()
