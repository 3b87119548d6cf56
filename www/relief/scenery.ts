/** The surface, its light and the eye that looks at it, in three.js. */

import {
  AmbientLight,
  BufferAttribute,
  BufferGeometry,
  DirectionalLight,
  DoubleSide,
  Mesh,
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

import type { MeshData } from "../worker/protocol";

const FRONT = new Spherical(2.9, Math.PI / 2 - 0.2, 0.36);
/** How near and far the eye may go; the surface is about two units wide. */
const NEAREST = 1;
const FARTHEST = 12;
/** Warm white, as of unfired clay. */
const PLASTER = 0xe4e0d8;

export class Scenery {
  readonly canvas: HTMLCanvasElement;
  private readonly renderer: WebGLRenderer;
  private readonly scene = new Scene();
  private readonly camera = new PerspectiveCamera(38, 1, 0.05, 30);
  private readonly controls: OrbitControls;
  private readonly light = new DirectionalLight(0xffffff, 2.6);
  private readonly material = new MeshStandardMaterial({ side: DoubleSide, roughness: 0.92 });
  private readonly surface = new Mesh(new BufferGeometry(), this.material);
  private texture: CanvasTexture | null = null;
  private plaster = false;
  private waiting = false;

  constructor(private readonly place: HTMLElement) {
    this.renderer = new WebGLRenderer({
      antialias: true,
      alpha: true,
      preserveDrawingBuffer: true,
    });
    this.renderer.setPixelRatio(Math.min(2, window.devicePixelRatio || 1));
    this.canvas = this.renderer.domElement;
    this.canvas.tabIndex = 0;
    this.canvas.setAttribute("role", "application");
    this.canvas.setAttribute(
      "aria-label",
      "Relief. Arrow keys turn it, plus and minus come closer and go away, Home looks from the front.",
    );
    place.append(this.canvas);
    this.scene.add(this.surface, this.light, new AmbientLight(0xffffff, 0.75));
    this.controls = new OrbitControls(this.camera, this.canvas);
    this.controls.enablePan = false;
    this.controls.minDistance = NEAREST;
    this.controls.maxDistance = FARTHEST;
    this.controls.addEventListener("change", () => this.invalidate());
    this.home();
    new ResizeObserver(() => this.resize()).observe(place);
    this.resize();
  }

  setMesh({ positions, normals, uvs, indices }: MeshData): void {
    const geometry = new BufferGeometry();
    geometry.setAttribute("position", new BufferAttribute(positions, 3));
    geometry.setAttribute("normal", new BufferAttribute(normals, 3));
    geometry.setAttribute("uv", new BufferAttribute(uvs, 2));
    geometry.setIndex(new BufferAttribute(indices, 1));
    this.surface.geometry.dispose();
    this.surface.geometry = geometry;
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
    this.setMaterial(this.plaster);
  }

  setMaterial(plaster: boolean): void {
    this.plaster = plaster;
    this.material.map = plaster ? null : this.texture;
    this.material.color.set(plaster ? PLASTER : 0xffffff);
    this.material.needsUpdate = true;
    this.invalidate();
  }

  /** Light from `angle` about the line of sight, 0 from the right, a quarter turn from above. */
  setLight(angle: number): void {
    this.light.position.set(1.4 * Math.cos(angle), 1.4 * Math.sin(angle), 1.3);
    this.invalidate();
  }

  turn(across: number, down: number): void {
    const seat = new Spherical().setFromVector3(this.camera.position);
    seat.theta -= across;
    seat.phi = Math.min(Math.PI - 0.05, Math.max(0.05, seat.phi - down));
    this.sit(seat);
  }

  approach(factor: number): void {
    const seat = new Spherical().setFromVector3(this.camera.position);
    seat.radius = Math.min(FARTHEST, Math.max(NEAREST, seat.radius * factor));
    this.sit(seat);
  }

  home(): void {
    this.sit(FRONT);
  }

  resize(): void {
    const { clientWidth: width, clientHeight: height } = this.place;
    if (width === 0 || height === 0) return;
    this.renderer.setSize(width, height, false);
    this.camera.aspect = width / height;
    // A tall stage must not cut the sides off.
    this.camera.zoom = Math.min(1, this.camera.aspect / 1.2);
    this.camera.updateProjectionMatrix();
    this.invalidate();
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
    if (this.place.hidden) return;
    this.renderer.render(this.scene, this.camera);
  }
}
