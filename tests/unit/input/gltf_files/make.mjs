// Writes three.gltf and the packed balls of tests/regression/features, by other programs. Run it in a
// folder where npm has installed three, @gltf-transform/core, @gltf-transform/extensions,
// @gltf-transform/functions, draco3dgltf and meshoptimizer: node make.mjs ROOT_OF_THIS_PROJECT
import fs from 'fs';
import { Document, NodeIO } from '@gltf-transform/core';
import { ALL_EXTENSIONS } from '@gltf-transform/extensions';
import { draco, meshopt, quantize } from '@gltf-transform/functions';
import draco3d from 'draco3dgltf';
import { MeshoptDecoder, MeshoptEncoder } from 'meshoptimizer';
import * as THREE from 'three';

const root = process.argv[2];
const folder = `${root}/tests/unit/input/gltf_files/`;

// The exporter of three.js uses a class of browsers.
globalThis.FileReader = class {
  readAsDataURL(blob) {
    blob.arrayBuffer().then((bytes) => {
      this.result = 'data:application/octet-stream;base64,' + Buffer.from(bytes).toString('base64');
      this.onloadend();
    });
  }
};
const { GLTFExporter } = await import('three/examples/jsm/exporters/GLTFExporter.js');

await MeshoptEncoder.ready;
await MeshoptDecoder.ready;
const io = new NodeIO().registerExtensions(ALL_EXTENSIONS).registerDependencies({
  'draco3d.encoder': await draco3d.createEncoderModule(),
  'draco3d.decoder': await draco3d.createDecoderModule(),
  'meshopt.encoder': MeshoptEncoder,
  'meshopt.decoder': MeshoptDecoder,
});
for (const [name, change] of [
  ['KHR_mesh_quantization', quantize()],
  ['KHR_draco_mesh_compression', draco({ method: 'edgebreaker' })],
  ['EXT_meshopt_compression', meshopt({ encoder: MeshoptEncoder, level: 'high' })],
]) {
  const document = await io.read(`${root}/tests/agreement/gltf/metal.gltf`);
  await document.transform(change);
  await io.write(`${root}/tests/regression/features/${name}.glb`, document);
}

// A triangle with colours as Blender stores them.
const colored = new Document();
const buffer = colored.createBuffer();
const attribute = (type, array) =>
  colored.createAccessor().setType(type).setArray(array).setBuffer(buffer);
const triangle = colored.createPrimitive()
  .setAttribute('POSITION', attribute('VEC3', new Float32Array([0, 0, 0, 1, 0, 0, 0, 1, 0])))
  .setAttribute('COLOR_0', attribute('VEC4', new Uint16Array(
    [65535, 0, 0, 65535, 0, 65535, 0, 65535, 0, 0, 13107, 13107])).setNormalized(true))
  .setIndices(attribute('SCALAR', new Uint16Array([0, 1, 2])));
colored.createScene().addChild(
  colored.createNode().setMesh(colored.createMesh().addPrimitive(triangle)));
await colored.transform(draco());
await io.write(`${folder}colors_draco.glb`, colored);

const scene = new THREE.Scene();
const glass = new THREE.MeshPhysicalMaterial({
  name: 'glass', roughness: 0.1, metalness: 0, transmission: 1, thickness: 0.5, ior: 1.4,
  attenuationColor: new THREE.Color(0.5, 1, 1), attenuationDistance: 2,
});
const paint = new THREE.MeshPhysicalMaterial({
  name: 'car', color: 0x802010, clearcoat: 0.7, clearcoatRoughness: 0.2, sheen: 1,
  sheenColor: new THREE.Color(0.1, 0.2, 0.3), sheenRoughness: 0.4, iridescence: 0.5,
  iridescenceIOR: 1.2, anisotropy: 0.3, specularIntensity: 0.9,
});
const box = new THREE.Mesh(new THREE.BoxGeometry(1, 1, 1), glass);
box.position.set(0, 0.5, 0);
const plane = new THREE.Mesh(new THREE.PlaneGeometry(4, 4), paint);
plane.rotation.x = -Math.PI / 2;
const camera = new THREE.PerspectiveCamera(40, 1.5, 0.1, 100);
camera.position.set(0, 1, 5);
const lamp = new THREE.SpotLight(0xffffff, 30, 0, 0.5, 0.5);
lamp.name = 'spot';
lamp.position.set(0, 4, 0);
lamp.target.position.set(0, 0, -1);
lamp.add(lamp.target);
scene.add(box, plane, camera, lamp);
scene.updateMatrixWorld(true);
const exported = await new GLTFExporter().parseAsync(scene, { binary: false });
fs.writeFileSync(`${folder}three.gltf`, JSON.stringify(exported));
