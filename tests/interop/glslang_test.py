# SPDX-License-Identifier: BSD-3-Clause
"""glslangValidator compiles the exported functions for OpenGL and for Vulkan."""

import re

import interop

MAIN = """
layout(location = 0) in vec3 to_light;
layout(location = 1) in vec3 to_viewer;
layout(location = 0) out vec4 colour;
void main()
{
    vec3 x = vec3(1.0, 0.0, 0.0), y = vec3(0.0, 1.0, 0.0), z = vec3(0.0, 0.0, 1.0);
    colour = vec4(%s(normalize(to_light), normalize(to_viewer), z, x, y), 1.0);
}
"""

MODELS = {
    "ggx": dict(rho_d=0.2, f0=0.04, f90=1, alpha=0.2),
    "ward-duer-gm": dict(rho_d=0.2, rho_s=0.1, alpha=0.2),
    "blinn-phong": dict(rho_d=0.2, rho_s=0.1, s=60),
}


class Glslang(interop.TestCase):
    def compile(self, body, function, check=True):
        source = self.folder / "shader.frag"
        source.write_text("#version 450\n" + body + MAIN % function)
        done = [interop.run(interop.program("glslangValidator"), *flags, source, check=check) for flags in ((), ("-V", "-o", self.folder / "shader.spv"))]
        return done[0]

    def test_functions(self):
        for model, parameters in MODELS.items():
            out = self.folder / "material.glsl"
            interop.gonio("export", self.fit(model, **parameters), "--to", "glsl", "--out", out)
            self.compile(out.read_text(), "brdf")
            self.check((self.folder / "shader.spv").stat().st_size > 0, f"{model} compiles")

    def test_disney(self):
        out = self.folder / "material.brdf"
        interop.gonio("export", self.fit("ggx", **MODELS["ggx"]), "--to", "disney", "--out", out)
        text = out.read_text()
        self.check(text.startswith("analytic\n"), "the first word of the format")
        parameters = re.search(r"::begin parameters\n(.*)::end parameters", text, re.S).group(1)
        body = ""
        for line in parameters.splitlines():
            kind, name, *numbers = line.split()
            body += f"const vec3 {name} = vec3({', '.join(numbers)});\n" if kind == "color" else f"const float {name} = {numbers[2]};\n"
        self.compile(body + re.search(r"::begin shader\n(.*)::end shader", text, re.S).group(1), "BRDF")
        self.check((self.folder / "shader.spv").stat().st_size > 0, "the shader of the .brdf file compiles")

    def test_a_wrong_function_is_seen(self):
        self.check(self.compile("vec3 brdf(vec3 L, vec3 V, vec3 N, vec3 X, vec3 Y) { return 1; }\n", "brdf", check=False).returncode != 0, "an int is no vec3")


interop.main()
