// What every 3-D view of the page does: a camera that turns about what it shows, light, size, and drawing when needed.

import { AmbientLight, Box3, Color, DirectionalLight, PerspectiveCamera, Scene, Vector3, WebGLRenderer } from "three";
import { OrbitControls } from "three/examples/jsm/controls/OrbitControls.js";
import { themeColour } from "./dom.js";

// Where an eye stands, relative to the run: x along it, y to its left.
export const DIRECTIONS = { "Three-quarter": [-0.75, -1.1, 0.75], Side: [0, -1, 0.02], Top: [0, -0.02, 1], "Along the track": [1, 0, 0.35] };

// Gives a canvas the height that goes with its width.
export function paintedSize(canvas, share = 0.55) {
  const width = Math.max(canvas.parentElement.clientWidth, 200);
  const height = Math.round(Math.min(Math.max(share * width, 260), 620));
  canvas.style.height = `${height}px`;
  return { width, height };
}

export class Stage {
  // What is shown goes into `scene`; `box` and `radius` tell how large it is, about the origin.
  constructor(canvas, azimuth) {
    this.canvas = canvas;
    this.azimuth = azimuth;
    this.renderer = new WebGLRenderer({ canvas, antialias: true, preserveDrawingBuffer: true });
    this.scene = new Scene();
    this.camera = new PerspectiveCamera(35, 1, 0.01, 100);
    this.camera.up.set(0, 0, 1);
    this.box = new Box3(new Vector3(-1, -1, -1), new Vector3(1, 1, 1));
    this.radius = 1;
    this.lamp = new DirectionalLight(0xffffff, 1.9);
    this.scene.add(new AmbientLight(0xffffff, 1.7), this.lamp);
    this.controls = new OrbitControls(this.camera, canvas);
    // The wheel scrolls the page past the view unless the view is what the reader works with.
    canvas.addEventListener("wheel", (event) => {
      this.controls.enableZoom = event.ctrlKey || document.activeElement === canvas;
    }, { capture: true, passive: true });
    canvas.addEventListener("pointerdown", () => canvas.focus({ preventScroll: true }));
    this.controls.addEventListener("change", () => this.render());
    this.controls.addEventListener("start", () => {
      this.direction = null;
    });
  }

  // Points whose hull holds all that is shown.
  corners() {
    const { min, max } = this.box;
    return [min.x, max.x].flatMap((x) => [min.y, max.y].flatMap((y) => [min.z, max.z].map((z) => new Vector3(x, y, z))));
  }

  // Where a camera that looks along -`direction` sees the whole box, as near as that goes.
  framing(direction) {
    const right = new Vector3().crossVectors(this.camera.up, direction).normalize();
    const above = new Vector3().crossVectors(direction, right);
    const tall = Math.tan(((this.camera.fov / 2) * Math.PI) / 180) / 1.12;
    const wide = tall * this.camera.aspect;
    const seen = this.corners().map((corner) => [corner.dot(right), corner.dot(above), corner.dot(direction)]);
    // Each side of the picture bounds a wedge; the camera stands where opposite wedges meet, at the greater depth.
    const span = (index, slope) => {
      const low = Math.max(...seen.map((p) => p[2] - p[index] / slope));
      const high = Math.max(...seen.map((p) => p[2] + p[index] / slope));
      return { middle: (slope * (high - low)) / 2, depth: (high + low) / 2 };
    };
    const [across, upward] = [span(0, wide), span(1, tall)];
    const target = right.multiplyScalar(across.middle).add(above.multiplyScalar(upward.middle));
    return { target, distance: Math.max(across.depth, upward.depth) };
  }

  look(name) {
    const [along, left, up] = DIRECTIONS[name];
    const { azimuth } = this;
    this.direction = name;
    const direction = new Vector3(
      along * Math.cos(azimuth) - left * Math.sin(azimuth), along * Math.sin(azimuth) + left * Math.cos(azimuth), up).normalize();
    const { target, distance } = this.framing(direction);
    this.camera.position.copy(target).addScaledVector(direction, distance);
    this.camera.near = Math.max(distance - 3 * this.radius, 0.005 * this.radius);
    this.camera.far = distance + 20 * this.radius;
    this.camera.updateProjectionMatrix();
    this.controls.target.copy(target);
    this.controls.update();
    this.render();
  }

  resize(width, height) {
    this.renderer.setPixelRatio(Math.min(window.devicePixelRatio, 2));
    this.renderer.setSize(width, height, false);
    this.camera.aspect = width / height;
    this.camera.updateProjectionMatrix();
    if (this.direction !== null) this.look(this.direction);
    this.render();
  }

  // Draws with the next frame, once for all that changed until then.
  render() {
    this.pending ??= requestAnimationFrame(() => this.renderNow());
  }

  renderNow() {
    cancelAnimationFrame(this.pending);
    this.pending = undefined;
    this.renderer.setClearColor(new Color(themeColour("--panel") || "#ffffff"));
    this.lamp.position.copy(this.camera.position).add(new Vector3(0, 0, this.radius));
    this.renderer.render(this.scene, this.camera);
    this.placeLabels();
  }

  // Texts that stand beside places of the picture.
  placeLabels() {}

  key(event) {
    const turn = 0.12;
    const offset = this.camera.position.clone().sub(this.controls.target);
    const right = new Vector3().crossVectors(this.camera.up, offset).normalize();
    const actions = {
      ArrowLeft: () => offset.applyAxisAngle(this.camera.up, -turn),
      ArrowRight: () => offset.applyAxisAngle(this.camera.up, turn),
      ArrowUp: () => offset.applyAxisAngle(right, -turn),
      ArrowDown: () => offset.applyAxisAngle(right, turn),
      "+": () => offset.multiplyScalar(0.85),
      "-": () => offset.multiplyScalar(1 / 0.85),
    };
    if (!actions[event.key]) return;
    event.preventDefault();
    this.direction = null;
    actions[event.key]();
    this.camera.position.copy(this.controls.target).add(offset);
    this.controls.update();
    this.render();
  }
}
