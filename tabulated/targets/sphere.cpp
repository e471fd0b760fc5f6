// SPDX-License-Identifier: BSD-3-Clause
#include "tabulated/targets/sphere.hpp"

#include "tabulated/targets/target.hpp"

namespace gonio::tabulated::targets {

std::string mitsuba_sphere(std::string_view comments, std::string_view material) {
  return filled(R"(<?xml version="1.0" encoding="utf-8"?>
<!--
{{comments}}-->
<scene version="3.0.0">
    <integrator type="path"/>
    <sensor type="perspective">
        <float name="fov" value="28"/>
        <transform name="to_world">
            <lookat origin="0, -5, 0" target="0, 0, 0" up="0, 0, 1"/>
        </transform>
        <film type="hdrfilm">
            <integer name="width" value="512"/>
            <integer name="height" value="512"/>
        </film>
        <sampler type="independent">
            <integer name="sample_count" value="64"/>
        </sampler>
    </sensor>
    <emitter type="constant">
        <rgb name="radiance" value="0.2, 0.2, 0.2"/>
    </emitter>
    <emitter type="directional">
        <vector name="direction" x="1" y="2" z="-2"/>
        <rgb name="irradiance" value="3, 3, 3"/>
    </emitter>
{{material}}    <shape type="sphere">
        <ref id="material"/>
    </shape>
</scene>
)",
                {{"comments", std::string(comments)}, {"material", std::string(material)}});
}

std::string pbrt_sphere(std::string_view comments, std::string_view material, std::string_view image) {
  return filled(R"({{comments}}LookAt 0 -5 0  0 0 0  0 0 1
Camera "perspective" "float fov" [ 28 ]
Sampler "independent" "integer pixelsamples" [ 64 ]
Integrator "path"
Film "rgb" "integer xresolution" [ 512 ] "integer yresolution" [ 512 ] "string filename" "{{image}}"
WorldBegin
LightSource "infinite" "rgb L" [ 0.2 0.2 0.2 ]
LightSource "distant" "point3 from" [ -1 -2 2 ] "point3 to" [ 0 0 0 ] "rgb L" [ 3 3 3 ]
{{material}}NamedMaterial "material"
Shape "sphere" "float radius" [ 1 ]
)",
                {{"comments", std::string(comments)}, {"material", std::string(material)}, {"image", std::string(image)}});
}

std::string radiance_sphere(std::string_view comments, std::string_view material) {
  // A source of 1 degree across and radiance 12539 gives an irradiance of 3.
  return filled(R"({{comments}}# oconv FILE.rad > scene.oct
# rpict -vp 0 -5 0 -vd 0 1 0 -vu 0 0 1 -vh 28 -vv 28 -ab 1 -ss 4 scene.oct > scene.hdr
{{material}}
material sphere ball
0
0
4 0 0 0 1

void light lamp
0
0
3 12539 12539 12539

lamp source sun
0
0
4 -1 -2 2 1

void glow sky_glow
0
0
4 0.2 0.2 0.2 0

sky_glow source sky
0
0
4 0 0 1 360
)",
                {{"comments", std::string(comments)}, {"material", std::string(material)}});
}

}  // namespace gonio::tabulated::targets
