# SPDX-License-Identifier: BSD-3-Clause
"""Khronos' glTF validator finds nothing to object to in what gonio writes."""

import json

import interop

VALIDATE = """
const validator = require(process.argv[1]);
const bytes = new Uint8Array(require("fs").readFileSync(process.argv[2]));
validator.validateBytes(bytes).then(
  (report) => console.log(JSON.stringify(report)),
  (error) => console.log(JSON.stringify({ issues: { numErrors: 1, messages: [String(error)] } })),
);
"""


class Gltf(interop.TestCase):
    def report(self, file):
        package, node = interop.node_package("gltf-validator"), interop.program("node")
        return interop.load_json(interop.run(node, "-e", VALIDATE, package, file))

    def check_valid(self, file):
        report = self.report(file)
        issues = report["issues"]
        self.check(issues["numErrors"] == 0 and issues["numWarnings"] == 0, f"no errors and no warnings: {issues}")
        self.check(report["info"]["totalTriangleCount"] > 1000, "a mesh to look at")
        return report

    def test_isotropic(self):
        fit = self.fit("ggx", ("r", "g", "b"), rho_d=0.2, f0=0.04, f90=1, alpha=0.2)
        out = self.folder / "material.gltf"
        interop.gonio("export", fit, "--to", "gltf", "--out", out)
        report = self.check_valid(out)
        self.check(set(report["info"]["extensionsUsed"]) == {"KHR_materials_ior", "KHR_materials_specular"}, f"extensions of {report['info']}")

    def test_anisotropic(self):
        rows = ["theta_i_deg,phi_i_deg,theta_o_deg,phi_o_deg,value"]
        pairs = [(i, p, o, q) for i in range(0, 70, 20) for p in range(0, 180, 30) for o in range(0, 80, 8) for q in range(0, 360, 30)]
        given = ("--param", "rho_d=0.1", "--param", "rho_s=0.3", "--param", "alpha_x=0.1", "--param", "alpha_y=0.3")
        for pair, value in zip(pairs, interop.evaluate("ward-duer-gm-anisotropic", pairs, *given)):
            rows.append(",".join(map(repr, [*pair, *value])))
        samples, out = self.folder / "samples.csv", self.folder / "material.gltf"
        samples.write_text("\n".join(rows) + "\n")
        interop.gonio("export", samples, "--to", "gltf", "--out", out)
        self.check_valid(out)
        extension = json.loads(out.read_text())["materials"][0]["extensions"]["KHR_materials_anisotropy"]
        self.near(extension["anisotropyRotation"], 1.5707963, 1e-6, "the long axis of the lobe is across the tangent")

    def test_a_damaged_file_is_seen(self):
        broken = self.folder / "broken.gltf"
        broken.write_text('{"asset":{"version":"2.0"},"scene":3}')
        self.check(self.report(broken)["issues"]["numErrors"] > 0, "the validator refuses a scene that is not there")


interop.main()
