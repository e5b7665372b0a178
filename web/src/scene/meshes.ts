// Copyright 2026 The amr_description authors
// SPDX-License-Identifier: Apache-2.0
/** Meshes of a URDF, from the node's `/mesh/…` and nowhere else. */
import { Camera, DoubleSide, Light, LoadingManager, Mesh } from 'three';
import type { Material, MeshPhongMaterial, Object3D } from 'three';
import { ColladaLoader } from 'three/examples/jsm/loaders/ColladaLoader.js';
import { OBJLoader } from 'three/examples/jsm/loaders/OBJLoader.js';
import { STLLoader } from 'three/examples/jsm/loaders/STLLoader.js';

/** The addresses of a model's files, by their names in the URDF. */
export type Files = Readonly<Record<string, string>>;

/** A manager whose loaders get what is in `files`, by its name, and refuse anything else. */
export function managerOf(files: Files): LoadingManager {
  const manager = new LoadingManager();
  manager.setURLModifier((name) => {
    const address = files[name];
    if (address === undefined) {
      throw new Error(`'${name}' was not found`);
    }
    return beside(address);
  });
  return manager;
}

/** An address of the node as one beside the page, which a proxy may have at a path. */
function beside(address: string): string {
  return address.replace(/^\//, '');
}

/** Fetch and read a mesh. Throws an Error with a message for the user. */
export async function loadMesh(
  name: string,
  files: Files,
  manager: LoadingManager,
  material: Material,
): Promise<Object3D> {
  const address = files[name];
  if (address === undefined) {
    throw new Error(`the mesh '${name}' was not found`);
  }
  const answer = await fetch(beside(address));
  if (!answer.ok) {
    throw new Error(`the mesh '${name}' was not served: ${answer.status} ${answer.statusText}`);
  }
  // Of what is served, which is not always what is named: glTF comes as STL.
  const kind = /\.(\w+)$/.exec(address)?.[1];
  switch (kind) {
    case 'stl':
      return new Mesh(new STLLoader().parse(await answer.arrayBuffer()), twoSided(material));
    case 'obj':
      return dress(new OBJLoader(manager).parse(await answer.text()), material);
    case 'dae':
      return readCollada(await answer.text(), folderOf(name), files, manager, material);
    default:
      throw new Error(`'${name}' is of a kind that is not drawn here: .stl, .dae, .obj and glTF are`);
  }
}

/**
 * A COLLADA scene without its lights and cameras, in m. Vertices are taken as they are, whatever
 * <up_axis> says, as RViz, Gazebo and the simulator (amr_description/model/meshes.py) do.
 */
function readCollada(
  text: string,
  folder: string,
  files: Files,
  manager: LoadingManager,
  material: Material,
): Object3D {
  const xml = new DOMParser().parseFromString(text, 'text/xml');
  xml.querySelectorAll('up_axis').forEach((axis) => (axis.textContent = 'Y_UP'));
  xml.querySelectorAll('library_images > image').forEach((image) => {
    const from = image.querySelector('init_from');
    const name = (from?.textContent ?? '').trim().replace(/^\.\//, '');
    if (from === null || files[folder + name] === undefined) {
      image.remove(); // drawn without; the loader only warns
    } else {
      from.textContent = name;
    }
  });
  const loader = new ColladaLoader(manager);
  loader.setResourcePath(folder);
  const collada = loader.parse(new XMLSerializer().serializeToString(xml), folder);
  if (collada === null) {
    throw new Error('it is no COLLADA file');
  }
  const { scene } = collada;
  const surplus: Object3D[] = [];
  scene.traverse((each) => {
    if (each instanceof Light || each instanceof Camera) {
      surplus.push(each);
    }
  });
  surplus.forEach((each) => each.removeFromParent());
  return dress(scene, material);
}

/** Give the URDF's material to what has none of its own; show both sides of all. */
function dress(object: Object3D, material: Material): Object3D {
  object.traverse((each) => {
    if (!(each instanceof Mesh)) {
      return;
    }
    const own = [each.material].flat() as MeshPhongMaterial[];
    const isPlain = own.every(({ name, map }) => name === '' && !map);
    if (isPlain) {
      each.material = twoSided(material);
    }
    own.forEach((one) => (one.side = DoubleSide));
  });
  return object;
}

/** Triangles of files may face either way. */
function twoSided(material: Material): Material {
  material.side = DoubleSide;
  return material;
}

function folderOf(name: string): string {
  return name.slice(0, name.lastIndexOf('/') + 1);
}
