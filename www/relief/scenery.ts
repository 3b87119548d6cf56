/** The surface, its light and the eye that looks at it, in three.js. */

import {
  AmbientLight,
  BufferAttribute,
  BufferGeometry,
  Color,
  DirectionalLight,
  DoubleSide,
  Material,
  Mesh,
  MeshBasicMaterial,
  MeshNormalMaterial,
  MeshStandardMaterial,
  PerspectiveCamera,
  Scene,
  Spherical,
  SRGBColorSpace,
  CanvasTexture,
  Vector3,
  WebGLRenderer,
} from "three";
import { OrbitControls } from "three/addons/controls/OrbitControls.js";

import { text } from "../text";
import type { MeshData } from "../worker/protocol";

/** Where the eye looks from at first: a little from above and from the right. */
const FRONT = { phi: Math.PI / 2 - 0.2, theta: 0.36 };
/** Share of the picture that the surface may fill then. */
const FILLED = 0.94;
/** Vertices looked at to find the middle and how far away the eye must be: each of so many. */
const SAMPLED = 11;
/** How near and far the eye may go; the surface is about two units wide. */
const NEAREST = 1;
const FARTHEST = 12;
/** Warm white, as of unfired clay. */
const PLASTER = 0xe4e0d8;
/** The same where it goes on hidden. */
const HIDDEN = 0x77736c;
/** Opacity of what is of unknown depth. */
const GHOST = 0.22;

export type Surface = "textured" | "plaster" | "wireframe" | "normals";

export class Scenery {
  readonly canvas: HTMLCanvasElement;
  private readonly renderer: WebGLRenderer;
  private readonly scene = new Scene();
  private readonly camera = new PerspectiveCamera(38, 1, 0.05, 30);
  private readonly controls: OrbitControls;
  private readonly light = new DirectionalLight(0xffffff, 2.6);
  /** Of what is seen, of what goes on hidden behind it, and of ghosts. */
  private materials: Material[] = [];
  private readonly surface = new Mesh(new BufferGeometry(), this.materials);
  private texture: CanvasTexture | null = null;
  private dress: [Surface, boolean] = ["textured", true];
  private waiting = false;
  private following = false;
  /** Nobody has turned the surface or come closer: the eye keeps all of it in view. */
  private atHome = true;

  /** `drawn` is called whenever the picture has changed, `moved` when somebody has turned the surface or come closer. */
  constructor(
    private readonly place: HTMLElement,
    private readonly drawn: () => void,
    private readonly moved: () => void,
  ) {
    this.renderer = new WebGLRenderer({
      antialias: true,
      alpha: true,
      preserveDrawingBuffer: true,
    });
    this.renderer.setPixelRatio(Math.min(2, window.devicePixelRatio || 1));
    this.canvas = this.renderer.domElement;
    this.canvas.tabIndex = 0;
    this.canvas.setAttribute("role", "application");
    this.canvas.setAttribute("aria-label", text.relief.keys);
    place.append(this.canvas);
    this.scene.add(this.surface, this.light, new AmbientLight(0xffffff, 0.75));
    this.controls = new OrbitControls(this.camera, this.canvas);
    this.controls.enablePan = false;
    this.controls.minDistance = NEAREST;
    this.controls.maxDistance = FARTHEST;
    this.controls.addEventListener("change", () => {
      this.invalidate();
      this.tell();
    });
    // It would keep fingers from scrolling the page; `touch.ts` says when it may.
    this.canvas.style.removeProperty("touch-action");
    this.controls.addEventListener("start", () => (this.atHome = false));
    this.setMaterial(...this.dress);
    this.home();
    this.lamp = [-0.55, 0.55, 0.63];
    new ResizeObserver(() => this.resize()).observe(place);
    this.resize();
  }

  setMesh({ positions, normals, uvs, colours, indices, parts }: MeshData): void {
    const geometry = new BufferGeometry();
    geometry.setAttribute("position", new BufferAttribute(positions, 3));
    geometry.setAttribute("normal", new BufferAttribute(normals, 3));
    geometry.setAttribute("uv", new BufferAttribute(uvs, 2));
    geometry.setAttribute("color", new BufferAttribute(linear(colours), 3));
    geometry.setIndex(new BufferAttribute(indices, 1));
    let start = 0;
    for (const [i, count] of parts.entries()) {
      geometry.addGroup(start, count, i);
      start += count;
    }
    this.surface.geometry.dispose();
    this.surface.geometry = geometry;
    this.surface.position.copy(this.middle().negate());
    if (this.atHome) this.home();
    this.invalidate();
  }

  setTexture(frame: ImageBitmap): void {
    // Drawn to a canvas of our own: a bitmap could be closed while three.js still wants it.
    const canvas = document.createElement("canvas");
    canvas.width = frame.width;
    canvas.height = frame.height;
    canvas.getContext("2d")!.drawImage(frame, 0, 0);
    this.texture?.dispose();
    this.texture = new CanvasTexture(canvas);
    this.texture.colorSpace = SRGBColorSpace;
    this.texture.anisotropy = this.renderer.capabilities.getMaxAnisotropy();
    this.setMaterial(...this.dress);
  }

  setMaterial(surface: Surface, ghosts: boolean): void {
    this.dress = [surface, ghosts];
    this.materials.forEach((material) => material.dispose());
    const cast = (color: number) =>
      new MeshStandardMaterial({
        side: DoubleSide,
        roughness: 0.92,
        color,
        wireframe: surface === "wireframe",
      });
    const [seen, hidden] = [cast(PLASTER), cast(HIDDEN)];
    if (surface === "textured") {
      seen.map = this.texture;
      seen.color.set(0xffffff);
      hidden.vertexColors = true;
      hidden.color.set(0xffffff);
    }
    const ghost = new MeshBasicMaterial({
      side: DoubleSide,
      transparent: true,
      opacity: surface === "wireframe" ? GHOST / 2 : GHOST,
      depthWrite: false,
      visible: ghosts,
      wireframe: surface === "wireframe",
      map: surface === "textured" ? this.texture : null,
    });
    this.materials =
      surface === "normals"
        ? [new MeshNormalMaterial({ side: DoubleSide }), hidden, ghost]
        : [seen, hidden, ghost];
    this.surface.material = this.materials;
    this.invalidate();
  }

  /** Where light comes from as the eye sees it: x to the right, y up, z towards the eye. */
  get lamp(): [number, number, number] {
    const turned = this.camera.quaternion.clone().invert();
    return this.light.position.clone().normalize().applyQuaternion(turned).toArray();
  }

  set lamp(from: [number, number, number]) {
    const direction = new Vector3(...from).normalize().applyQuaternion(this.camera.quaternion);
    this.light.position.copy(direction).multiplyScalar(2);
    this.invalidate();
  }

  /** Looks from where another looks from. */
  follow({ camera, atHome }: Scenery): void {
    if (this.place.hidden) return;
    this.atHome = atHome;
    this.following = true;
    this.camera.position.copy(camera.position);
    this.controls.update();
    this.following = false;
    this.invalidate();
  }

  /** Who follows this one hears of it, unless it follows itself. */
  private tell(): void {
    if (!this.following && !this.atHome) this.moved();
  }

  turn(across: number, down: number): void {
    this.atHome = false;
    const seat = new Spherical().setFromVector3(this.camera.position);
    seat.theta -= across;
    seat.phi = Math.min(Math.PI - 0.05, Math.max(0.05, seat.phi - down));
    this.sit(seat);
  }

  approach(factor: number): void {
    this.atHome = false;
    const seat = new Spherical().setFromVector3(this.camera.position);
    seat.radius = Math.min(FARTHEST, Math.max(NEAREST, seat.radius * factor));
    this.sit(seat);
  }

  home(): void {
    this.atHome = true;
    this.sit(new Spherical(this.distance(), FRONT.phi, FRONT.theta));
    if (!this.following) this.moved();
  }

  /** Places of some of the vertices, before the surface is moved to its middle. */
  private *sampled(): Generator<Vector3> {
    const places = this.surface.geometry.getAttribute("position");
    const place = new Vector3();
    for (let i = 0; i < (places?.count ?? 0); i += SAMPLED) {
      yield place.fromBufferAttribute(places!, i);
    }
  }

  private middle(): Vector3 {
    const sum = new Vector3();
    let count = 0;
    for (const place of this.sampled()) {
      sum.add(place);
      count += 1;
    }
    return sum.divideScalar(Math.max(1, count));
  }

  /** How far in front the eye must be to see all of the surface. */
  private distance(): number {
    const eye = new Vector3().setFromSphericalCoords(1, FRONT.phi, FRONT.theta);
    const right = new Vector3().crossVectors(this.camera.up, eye).normalize();
    const up = new Vector3().crossVectors(eye, right);
    const tall = FILLED * Math.tan((this.camera.fov * Math.PI) / 360);
    const wide = tall * this.camera.aspect;
    let distance = NEAREST;
    for (const place of this.sampled()) {
      place.add(this.surface.position);
      const aside = Math.max(Math.abs(place.dot(right)) / wide, Math.abs(place.dot(up)) / tall);
      distance = Math.max(distance, place.dot(eye) + aside);
    }
    return Math.min(FARTHEST, distance);
  }

  resize(): void {
    const { clientWidth: width, clientHeight: height } = this.place;
    if (width === 0 || height === 0) return;
    this.renderer.setSize(width, height, false);
    this.camera.aspect = width / height;
    this.camera.updateProjectionMatrix();
    if (this.atHome) this.home();
    this.invalidate();
  }

  /** The canvas, as it is now. */
  drawnCanvas(): HTMLCanvasElement {
    this.render();
    return this.canvas;
  }

  picture(): Promise<Blob | null> {
    this.render();
    return new Promise((resolve) => this.canvas.toBlob(resolve, "image/png"));
  }

  private sit(seat: Spherical): void {
    this.camera.position.copy(new Vector3().setFromSpherical(seat));
    this.controls.update();
    this.invalidate();
  }

  private invalidate(): void {
    if (this.waiting) return;
    this.waiting = true;
    requestAnimationFrame(() => {
      this.waiting = false;
      this.render();
    });
  }

  private render(): void {
    if (this.place.clientWidth === 0) return;
    this.renderer.render(this.scene, this.camera);
    this.drawn();
  }
}

/** Colours as three.js computes with them. */
function linear(colours: Uint8Array): Float32Array {
  const light = new Float32Array(colours.length);
  const colour = new Color();
  for (let i = 0; i < colours.length; i += 3) {
    const [r, g, b] = [colours[i]!, colours[i + 1]!, colours[i + 2]!];
    colour.setRGB(r / 255, g / 255, b / 255, SRGBColorSpace).toArray(light, i);
  }
  return light;
}
