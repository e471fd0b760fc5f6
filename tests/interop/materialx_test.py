# SPDX-License-Identifier: BSD-3-Clause
"""MaterialX takes our documents as valid, finds its own surfaces in them, and makes shaders of them."""

import interop


class MaterialX(interop.TestCase):
    def setUp(self):
        super().setUp()
        self.mx = interop.module("MaterialX")
        self.generator = interop.module("MaterialX.PyMaterialXGenGlsl")
        self.shaders = interop.module("MaterialX.PyMaterialXGenShader")
        self.library = self.mx.createDocument()
        self.paths = self.mx.getDefaultDataSearchPath()
        self.mx.loadLibraries(self.mx.getDefaultDataLibraryFolders(), self.paths, self.library)

    def read(self, file):
        document = self.mx.createDocument()
        self.mx.readFromXmlFile(document, str(file))
        document.importLibrary(self.library)
        return document

    def export(self, target, model, **parameters):
        fit = self.fit(model, ("r", "g", "b"), **parameters)
        out = self.folder / f"{target}.mtlx"
        interop.gonio("export", fit, "--to", target, "--out", out)
        return out

    def check_document(self, file, surface):
        document = self.read(file)
        valid, message = document.validate()
        self.check(valid, f"{file.name} is valid: {message}")
        material = document.getMaterialNodes()[0]
        node = self.mx.getShaderNodes(material)[0]
        definition = node.getNodeDef()
        self.check(definition is not None and definition.getNodeString() == surface, f"{surface} of the standard libraries")
        for given in node.getInputs():
            self.check(definition.getActiveInput(given.getName()) is not None, f"{surface} has an input {given.getName()}")
        generator = self.generator.GlslShaderGenerator.create()
        context = self.shaders.GenContext(generator)
        context.registerSourceCodeSearchPath(self.paths)
        shader = generator.generate("gonio", material, context)
        source = self.folder / "shader.frag"
        source.write_text(shader.getSourceCode("pixel"))
        interop.run(interop.program("glslangValidator"), "-S", "frag", source)

    def test_standard_surface(self):
        self.check_document(self.export("materialx-standard-surface", "ggx", rho_d=0.2, f0=0.04, f90=1, alpha=0.2), "standard_surface")

    def test_open_pbr(self):
        self.check_document(self.export("openpbr", "ggx", rho_d=0.01, f0=0.8, f90=1, alpha=0.3), "open_pbr_surface")

    def test_an_input_of_another_type_is_seen(self):
        file = self.export("openpbr", "ggx", rho_d=0.01, f0=0.8, f90=1, alpha=0.3)
        file.write_text(file.read_text().replace('name="specular_ior" type="float"', 'name="specular_ior" type="color3"'))
        valid, _ = self.read(file).validate()
        self.check(not valid, "MaterialX refuses an input of another type")


interop.main()
