# SPDX-License-Identifier: BSD-3-Clause
"""Blender imports our glTF, builds our material, and Cycles shades a sphere of it as the formula says."""

import json
import math

import interop

# A sphere of the material under a sun of irradiance 1, seen from above without perspective: every pixel is a normal.
SHADE = """
import bpy, json, runpy, sys
program, size, light, out = sys.argv[-4], int(sys.argv[-3]), json.loads(sys.argv[-2]), sys.argv[-1]
material = runpy.run_path(program)["material"]
bpy.ops.wm.read_factory_settings(use_empty=True)
bpy.ops.mesh.primitive_uv_sphere_add(segments=256, ring_count=128, radius=1.0)
ball = bpy.context.object
bpy.ops.object.shade_smooth()
ball.data.materials.append(material())
import mathutils
towards = mathutils.Vector(light)
bpy.ops.object.light_add(type="SUN", rotation=towards.to_track_quat("Z", "Y").to_euler())
bpy.context.object.data.energy = 1.0
bpy.context.object.data.angle = 0.0
bpy.ops.object.camera_add(location=(0.0, 0.0, 5.0))
here = bpy.context.scene
here.camera = bpy.context.object
here.camera.data.type = "ORTHO"
here.camera.data.ortho_scale = 2.0
here.render.engine = "CYCLES"
here.cycles.samples = 4
here.cycles.use_denoising = False
here.cycles.max_bounces = 0
here.cycles.pixel_filter_type = "BLACKMAN_HARRIS"
here.cycles.filter_width = 0.01
here.render.resolution_x = here.render.resolution_y = size
here.render.image_settings.file_format = "OPEN_EXR"
here.render.image_settings.color_depth = "32"
here.render.filepath = out
bpy.ops.render.render(write_still=True)
picture = bpy.data.images.load(out)
picture.colorspace_settings.name = "Non-Color"
print("PIXELS " + json.dumps(list(picture.pixels)))
"""

# Debian 12's numpy has dropped a name that its Blender's importer uses.
IMPORT = """
import bpy, json, numpy, sys
numpy.bool = bool
bpy.ops.wm.read_factory_settings(use_empty=True)
bpy.ops.import_scene.gltf(filepath=sys.argv[-1])
ball = bpy.context.scene.objects["sphere"]
node = ball.data.materials[0].node_tree.nodes["Principled BSDF"]
value = lambda name: node.inputs[name].default_value
print("FOUND " + json.dumps({"vertices": len(ball.data.vertices), "base": list(value("Base Color")), "metallic": value("Metallic"),
                              "roughness": value("Roughness")}))
"""


class Blender(interop.TestCase):
    def blender(self, text, *arguments):
        """The program's lines of output from a Python program run inside Blender."""
        script = self.folder / "script.py"
        script.write_text(text)
        return interop.run(interop.program("blender"), "-b", "--factory-startup", "-P", script, "--", *arguments)

    def found(self, output, word):
        lines = [line[len(word) + 1 :] for line in output.splitlines() if line.startswith(word + " ")]
        self.check(len(lines) == 1, f"one line {word} in\n{output}")
        return json.loads(lines[0])

    def values(self, program):
        names = {}
        exec(program.read_text().split("def material")[0].replace("import bpy", ""), names)
        return names["VALUES"]

    @staticmethod
    def formula(v, light, viewer):
        """Blender 3.4's Principled BSDF without its colour: red channel, f [1/sr]."""
        base, metal, rough = v["Base Color"][0], v["Metallic"], v["Roughness"]
        f0 = 0.08 * v["Specular"]
        n = (1 + math.sqrt(f0)) / (1 - math.sqrt(f0))
        half = [a + b for a, b in zip(light, viewer)]
        length = math.sqrt(sum(x * x for x in half))
        c, a2 = length / 2, rough**4
        cos2 = (half[2] / length) ** 2
        d = a2 / (math.pi * (cos2 * (a2 - 1) + 1) ** 2)
        g = 1
        for w in (light, viewer):
            g *= 2 / (1 + math.sqrt(1 + a2 * (1 / w[2] ** 2 - 1)))
        t = math.sqrt(1 - (1 - c * c) / n**2)
        fresnel = (((c - n * t) / (c + n * t)) ** 2 + ((n * c - t) / (n * c + t)) ** 2) / 2
        rise = (fresnel - f0) / (1 - f0)
        normal = (1 - metal) * f0 + metal * base
        f90 = 0.5 + 2 * rough * c * c
        diffuse = base / math.pi
        for w in (light, viewer):
            diffuse *= 1 + (f90 - 1) * (1 - w[2]) ** 5
        return (1 - metal) * diffuse + (normal + (1 - normal) * rise) * d * g / (4 * light[2] * viewer[2])

    def check_shading(self, name, fit):
        program = self.folder / f"{name}.py"
        interop.gonio("export", fit, "--to", "blender", "--out", program)
        size, light = 48, (0.48, 0.36, 0.8)
        pixels = self.found(self.blender(SHADE, program, size, json.dumps(light), self.folder / "out.exr"), "PIXELS")
        values, differences = self.values(program), []
        for row in range(size):
            for column in range(size):
                x, y = (2 * column + 1) / size - 1, (2 * row + 1) / size - 1
                if x * x + y * y > 0.8:
                    continue
                normal = (x, y, math.sqrt(1 - x * x - y * y))
                cos_i = sum(a * b for a, b in zip(normal, light))
                if cos_i < 0.3:
                    continue
                # Only the angles matter to an isotropic material: put the normal on z.
                cos_o, between = normal[2], light[2]
                sin_i, sin_o = math.sqrt(1 - cos_i**2), math.sqrt(1 - cos_o**2)
                cos_phi = max(-1, min(1, (between - cos_i * cos_o) / (sin_i * sin_o))) if sin_i * sin_o > 1e-9 else 1
                wi = (sin_i, 0, cos_i)
                wo = (sin_o * cos_phi, sin_o * math.sqrt(1 - cos_phi**2), cos_o)
                wanted = self.formula(values, wi, wo) * cos_i
                differences.append(abs(pixels[4 * (row * size + column)] - wanted) / wanted)
        differences.sort()
        count = len(differences)
        middle, worst = differences[count // 2], differences[-1]
        # Facets of the mesh bend the normal at the flanks of the lobe, most at the pole in the middle of the picture.
        self.check(count > 500 and middle < 0.001 and worst < 0.05, f"{name}: relative differences {middle!r} and {worst!r} at {count} pixels")

    def test_plastic(self):
        self.check_shading("plastic", self.fit("ggx", rho_d=0.3, f0=0.05, f90=1, alpha=0.3))

    def test_metal(self):
        self.check_shading("metal", self.fit("ggx", rho_d=0.01, f0=0.7, f90=1, alpha=0.3))

    def test_its_own_scene_renders(self):
        program, picture = self.folder / "material.py", self.folder / "sphere.png"
        interop.gonio("export", self.fit("ggx", rho_d=0.3, f0=0.05, f90=1, alpha=0.3), "--to", "blender", "--out", program)
        interop.run(interop.program("blender"), "-b", "-P", program, "--", "--render", picture, "--samples", "2", "--size", "32")
        self.check(picture.read_bytes()[:8] == b"\x89PNG\r\n\x1a\n", "a picture")

    def test_gltf_import(self):
        fit, out = self.fit("ggx", ("r", "g", "b"), rho_d=0.2, f0=0.04, f90=1, alpha=0.2), self.folder / "material.gltf"
        interop.gonio("export", fit, "--to", "gltf", "--out", out)
        found = self.found(self.blender(IMPORT, out), "FOUND")
        written = json.loads(out.read_text())["materials"][0]["pbrMetallicRoughness"]
        self.check(found["vertices"] > 1000, f"a sphere: {found}")
        for c in range(3):
            self.near(found["base"][c], written["baseColorFactor"][c], 1e-6, "base colour")
        self.near(found["metallic"], written["metallicFactor"], 1e-6, "metallic")
        self.near(found["roughness"], written["roughnessFactor"], 1e-6, "roughness")


interop.main()
