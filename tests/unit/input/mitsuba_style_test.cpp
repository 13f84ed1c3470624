// Scenes as exporters and people write them: all forms of values, names and nesting. None of them
// gets a warning.
#include "unit/input/mitsuba_samples.h"

namespace nephroid::testing {
namespace {

/// A room as converters of Mitsuba 3 write it.
const std::string kRoom = R"(<?xml version="1.0" encoding="utf-8"?>
<!-- exported -->
<scene version="3.0.0">
	<default name="integrator" value="path" />
	<default name="spp" value="64" />
	<default name="resx" value="320" />
	<default name="resy" value="180" />
	<default name="max_depth" value="65" />

	<integrator type='$integrator' id="elm__0" name="elm__0">
		<integer name="max_depth" value="$max_depth" />
		<integer name="rr_depth" value="5"/>
	</integrator>
	<sampler type="independent" id="sampler"><integer name="sample_count" value="$spp" /></sampler>
	<sensor type="perspective" id="camera" name="camera">
		<string name="fov_axis" value="larger" />
		<float name="fov" value="39.3077" />
		<float name="near_clip" value="0.1" /><float name="far_clip" value="1e3"/>
		<float name="principal_point_offset_x" value="-0.0" />
		<transform name="to_world">
			<lookat origin="0,  1.5,  6.8" target="0,  1,  0" up="0,  1,  0" />
		</transform>
		<ref id="sampler"/>
		<film type="hdrfilm">
			<integer name="width" value="$resx" />
			<integer name="height" value="$resy" />
			<string name="file_format" value="openexr" />
			<string name="pixel_format" value="rgb" />
			<string name="component_format" value="float16" />
			<rfilter type="tent" />
		</film>
	</sensor>

	<bsdf type="twosided" id="Wall"><bsdf type="diffuse" name="bsdf">
		<rgb name="reflectance" value="0.725, 0.71, 0.68" /></bsdf></bsdf>
	<bsdf type="twosided" id="Wood"><bsdf type="roughplastic">
		<float name="int_ior" value="1.5" /><float name="ext_ior" value="1" />
		<float name="alpha" value=".1" />
		<string name="distribution" value="ggx" />
		<boolean name="nonlinear" value="True" />
		<texture name="diffuse_reflectance" type="bitmap">
			<string name="filename" value="textures/wood.jpg" />
			<string name="filter_type" value="bilinear" />
			<string name="wrap_mode" value="repeat"/>
			<boolean name="raw" value="false"/>
			<transform name="to_uv"><scale x="4" y="4"/><rotate z="1" angle="-30"/></transform>
		</texture></bsdf></bsdf>
	<bsdf type="twosided" id="Steel"><bsdf type="roughconductor">
		<rgb name="eta" value="1.65746, 0.880369, 0.521229" />
		<rgb name="k" value="9.22387 6.26952 4.837" />
		<rgb name="specular_reflectance" value="#ffffff" />
		<texture name="alpha" type="bitmap"><string name="filename" value="textures/scratches.png"/>
			<boolean name="raw" value="true"/></texture>
		<string name="distribution" value="ggx"/></bsdf></bsdf>
	<bsdf type="dielectric" id="Glass"><string name="int_ior" value="bk7"/>
		<string name="ext_ior" value="air"/></bsdf>
	<bsdf type="thindielectric" id="Window"><float name="int_ior" value="1.5"/></bsdf>
	<bsdf type="mask" id="Leaf">
		<texture name="opacity" type="bitmap"><string name="filename" value="textures/leaf.png"/></texture>
		<bsdf type="twosided"><bsdf type="bumpmap">
			<texture name="arbitrary" type="bitmap"><boolean name="raw" value="true"/>
				<string name="filename" value="textures/bump.tga"/></texture>
			<float name="scale" value="0.5"/>
			<bsdf type="diffuse"><spectrum name="reflectance" value="400:0.5, 500:0.6, 700:0.8"/></bsdf>
		</bsdf></bsdf></bsdf>
	<bsdf type="normalmap" id="Tiles">
		<texture name="normalmap" type="bitmap"><boolean name="raw" value="true"/>
			<string name="filename" value="textures/normal.png"/>
			<transform name="to_uv"><scale value="8"/></transform></texture>
		<ref name="bsdf" id="Wall"/></bsdf>

	<shape type="obj" id="table" name="table">
		<string name="filename" value="mesh.obj" />
		<boolean name="face_normals" value="true"/><boolean name="flip_tex_coords" value="false"/>
		<transform name="to_world">
			<matrix value="-0.0757886 0.00519934 0.0335139 -0.3, 0 0 -0.0836047 0.5,
				-0.0339 -0.0116 -0.0749 1.2,
				0 0 0 1" /></transform>
		<ref id="Wood" />
	</shape>
	<shape type="ply"><string name="filename" value="mesh.ply" /><ref id="Steel" name="bsdf"/>
		<transform name="to_world"><scale value="0.5"/><rotate value="0, 1, 0" angle="90"/>
			<rotate x="1" angle="-90"/><translate value="1, 2, 3"/><translate x="1" z="-2"/></transform>
	</shape>
	<shape type="sphere"><point name="center" x="0" y="0.5" z="-.25"/><ref id="Glass"/></shape>
	<shape type="sphere"><point name="center" value="1, 1, 1"/><float name="radius" value="5e-1"/>
		<ref id="Leaf"/></shape>
	<shape type="cube"><transform name="to_world"><scale value="1 2 3"/></transform>
		<ref id="Tiles"/></shape>
	<shape type="rectangle" id="Light"><boolean name="flip_normals" value="true"/>
		<transform name="to_world"><lookat origin="-4,4,20" target="0,0,0" up="0,0,1"/></transform>
		<bsdf type="diffuse" id="LightBSDF"><rgb name="reflectance" value="0"/></bsdf>
		<emitter type="area"><rgb name="radiance" value="17, 12, 4" /></emitter></shape>
	<emitter type="envmap" id="sky"><transform name="to_world">
			<matrix value="1 0 0 0 0 1 0 0 0 0 1 0 0 0 0 1"/></transform>
		<string name="filename" value="sky.exr" /><float name="scale" value="2"/></emitter>
	<emitter type="point"><rgb name="intensity" value="10"/>
		<transform name="to_world"><translate x="1" y="2" z="3"/></transform></emitter>
	<emitter type="directional"><vector name="direction" x="0" y="-1" z="0.5"/>
		<spectrum name="irradiance" value="1.0"/></emitter>
</scene>
)";

TEST(MitsubaStyle, ARoomOfMitsuba3LoadsWithoutAWarning) {
  MitsubaScene scene;
  write_sample_files(scene.folder());
  const SceneDescription d = scene.read_file(kRoom);
  EXPECT_EQ(scene.warnings(), "");
  EXPECT_EQ(d.shapes.size(), 6u);
  EXPECT_EQ(d.lights.size(), 3u);
  EXPECT_EQ(number(d.sampler->parameters, "pixelsamples"), 64);
  EXPECT_EQ(number(d.integrator->parameters, "maxdepth"), 64);
  EXPECT_EQ(number(d.film->parameters, "xresolution"), 320);
  const MaterialDescription table = material(d, d.shapes.at(0).material.name);
  EXPECT_EQ(table.type, "coateddiffuse");
  EXPECT_EQ(parameter(table.parameters, "reflectance").type, "texture");
  EXPECT_TRUE(
      has_parameter(material(d, d.shapes.at(4).material.name).parameters, "normalmap.uvtransform"));
  const ShapeDescription& leaf = d.shapes.at(3);
  EXPECT_EQ(parameter(leaf.parameters, "alpha").type, "texture");
  EXPECT_TRUE(has_parameter(material(d, leaf.material.name).parameters, "displacement"));
}

/// The same scene with names of properties and values as in Mitsuba 0.6.
const std::string kOldRoom = R"(<scene version="0.6.0">
	<integrator type="path"><integer name="maxDepth" value="-1"/><integer name="rrDepth" value="10"/>
		<boolean name="strictNormals" value="false"/></integrator>
	<sensor type="thinlens">
		<float name="nearClip" value="0.1"/><float name="farClip" value="100"/>
		<float name="apertureRadius" value="0.1"/><float name="focusDistance" value="4"/>
		<string name="focalLength" value="35mm"/><float name="shutterOpen" value="0"/>
		<float name="shutterClose" value="0"/>
		<transform name="toWorld"><scale x="-1"/>
			<lookAt origin="3 3 3" target="0 0 0" up="0 0 1"/></transform>
		<sampler type="ldsampler"><integer name="sampleCount" value="256"/></sampler>
		<film type="hdrfilm"><integer name="width" value="64"/><integer name="height" value="64"/>
			<integer name="cropOffsetX" value="8"/><integer name="cropWidth" value="16"/>
			<boolean name="banner" value="false"/><boolean name="highQualityEdges" value="true"/>
			<rfilter type="gaussian"><float name="stddev" value="0.5"/></rfilter></film>
	</sensor>
	<texture type="scale" id="bumps"><float name="scale" value="10"/>
		<texture type="bitmap"><string name="filename" value="bump.png"/>
			<float name="gamma" value="1"/><float name="uvscale" value="2"/>
			<string name="filterType" value="ewa"/><float name="maxAnisotropy" value="20"/></texture>
	</texture>
	<bsdf type="bumpmap" id="rough"><ref id="bumps"/>
		<bsdf type="roughconductor"><string name="material" value="Al"/>
			<string name="distribution" value="ggx"/><float name="alphaU" value="0.05"/>
			<float name="alphaV" value="0.3"/></bsdf></bsdf>
	<shape type="serialized"><string name="filename" value="mesh.serialized"/>
		<integer name="shapeIndex" value="0"/><boolean name="faceNormals" value="true"/>
		<boolean name="flipNormals" value="false"/>
		<transform name="toWorld"><matrix value="1,0,0,0,0,1,0,0,0,0,1,0,0,0,0,1"/></transform>
		<bsdf type="twosided"><ref id="rough"/></bsdf></shape>
	<shape type="sphere"><bsdf type="dielectric"><string name="intIOR" value="Water Ice"/>
			<float name="extIOR" value="1.0"/></bsdf>
		<medium type="homogeneous" name="interior"><spectrum name="sigmaS" value="1"/>
			<rgb name="sigmaA" value="0.1,0.2,0.3"/><phase type="hg"><float name="g" value="0.7"/></phase>
		</medium></shape>
	<shape type="rectangle"><emitter type="area"><srgb name="radiance" value="#fff0e0"/>
		<float name="samplingWeight" value="2"/></emitter></shape>
	<shape type="disk"><emitter type="area"><spectrum name="radiance" value="400:1 500:2 700:3"/>
		</emitter></shape>
	<emitter type="spot"><transform name="toWorld"><lookat origin="0,0,2" target="0, 0, 0"/></transform>
		<spectrum name="intensity" value="10"/><float name="cutoffAngle" value="30"/>
		<float name="beamWidth" value="20"/></emitter>
	<emitter type="constant"><blackbody name="radiance" temperature="5000K" scale="1e-4"/></emitter>
</scene>
)";

TEST(MitsubaStyle, ARoomOfMitsuba06LoadsWithoutAWarning) {
  MitsubaScene scene;
  write_sample_files(scene.folder());
  const SceneDescription d = scene.read_file(kOldRoom);
  EXPECT_EQ(scene.warnings(), "");
  EXPECT_EQ(d.shapes.size(), 4u);
  EXPECT_EQ(d.lights.size(), 2u);
  EXPECT_EQ(parameter(d.film->parameters, "pixelbounds").numbers,
            (std::vector<double>{8, 24, 0, 64}));
  const ParameterSet metal = material(d, d.shapes.at(0).material.name).parameters;
  EXPECT_EQ(number(metal, "uroughness"), 0.05);
  EXPECT_TRUE(has_parameter(metal, "displacement"));
}

}  // namespace
}  // namespace nephroid::testing
