/** Shapes as the graphics card draws them: the shader that colours them, and their arrays. */
import { BufferAttribute, BufferGeometry, LineSegments, Mesh, ShaderMaterial } from "three";
import type { Shape } from "./geometry";

/** Stands for "no value" where a graphics card would not keep NaN. */
export const NONE = -1e30;
/** The same of a place that is not there yet, where a body grows: it is not drawn. */
const GONE = -2e30;

export const VERTEX = `
in vec3 disp; in float value; in float angle;
uniform float scale;
out vec3 vPlace; out vec3 vEye; out vec3 vNormal; out float vValue; out float vThere; out float vGone;
vec3 turned(vec3 p, float a) { if (a == 0.0) return p; return vec3(p.x * cos(a) + p.z * sin(a), p.y, p.z * cos(a) - p.x * sin(a)); }
void main() {
  vPlace = position;
  vec3 p = turned(position + scale * disp, angle);
  vec4 eye = modelViewMatrix * vec4(p, 1.0);
  vEye = eye.xyz;
  vNormal = normalMatrix * turned(normal, angle);
  vThere = value > -1e29 ? 1.0 : 0.0;
  vGone = value < -1.5e30 ? 1.0 : 0.0;
  vValue = value > -1e29 ? value : 0.0;
  gl_Position = projectionMatrix * eye;
}`;

export const FRAGMENT = `
precision highp float;
uniform sampler2D map;
uniform float low; uniform float high; uniform float bands; uniform bool logarithmic;
uniform vec4 cut; uniform bool cutting; uniform vec2 only; uniform bool onlyOn;
uniform int style; // 0: lit skin, 1: flat, 2: lit by the triangles themselves, 3: ghost, 4: line
uniform vec3 plain; uniform float opacity;
in vec3 vPlace; in vec3 vEye; in vec3 vNormal; in float vValue; in float vThere; in float vGone;
out vec4 colour;
void main() {
  if (vGone > 1e-4 || (cutting && dot(vPlace, cut.xyz) > cut.w)) discard;
  bool there = vThere > 0.999;
  if (onlyOn && style != 2 && style != 3 && (!there || vValue < only.x || vValue > only.y)) discard;
  if (style == 4) { colour = vec4(plain, opacity); return; }
  if (style == 3) {
    float rim = 1.0 - abs(normalize(vNormal).z);
    colour = vec4(plain, opacity * (0.35 + 0.65 * rim));
    return;
  }
  float s = logarithmic ? log(max(vValue, low) / low) / log(high / low) : (vValue - low) / max(high - low, 1e-30);
  s = clamp(s, 0.0, 1.0);
  if (bands > 0.5) s = (min(floor(s * bands), bands - 1.0) + 0.5) / bands;
  vec3 c = there ? texture(map, vec2((s * 255.0 + 0.5) / 256.0, 0.5)).rgb : plain;
  float light = 1.0;
  if (style != 1) {
    vec3 n = style == 2 ? normalize(cross(dFdx(vEye), dFdy(vEye))) : normalize(vNormal);
    light = 0.62 + 0.38 * abs(dot(n, normalize(vec3(0.25, 0.35, 1.0))));
  }
  colour = vec4(c * light, 1.0);
}`;

/** A shape with what the graphics card knows of it. */
export class Drawn {
  readonly mesh: Mesh;
  readonly features: LineSegments;
  readonly edges: LineSegments;
  readonly position: Float32Array;
  readonly disp: Float32Array;
  readonly value: Float32Array;
  private attributes: BufferAttribute[];
  private shownValues?: Float32Array;
  private shownPlaces?: Float32Array;
  private shownParts: Float32Array[] = [];

  constructor(readonly body: number, readonly shape: Shape, x: Float32Array, material: ShaderMaterial, line: ShaderMaterial) {
    const n = shape.a.length;
    this.position = new Float32Array(3 * n);
    this.disp = new Float32Array(3 * n);
    this.value = new Float32Array(n).fill(NONE);
    const { a, b, t } = shape;
    for (let i = 0; i < n; ++i)
      for (let c = 0; c < 3; ++c) this.position[3 * i + c] = (1 - t[i]) * x[3 * a[i] + c] + t[i] * x[3 * b[i] + c];
    this.attributes = [new BufferAttribute(this.disp, 3), new BufferAttribute(this.value, 1)];
    const common: [string, BufferAttribute][] = [
      ["position", new BufferAttribute(this.position, 3)],
      ["normal", new BufferAttribute(shape.normal, 3)],
      ["angle", new BufferAttribute(shape.angle ?? new Float32Array(n), 1)],
      ["disp", this.attributes[0]],
      ["value", this.attributes[1]],
    ];
    const geometry = (index: Uint32Array) => {
      const g = new BufferGeometry();
      for (const [name, attribute] of common) g.setAttribute(name, attribute);
      g.setIndex(new BufferAttribute(index, 1));
      return g;
    };
    this.mesh = new Mesh(geometry(shape.triangles), material);
    this.features = new LineSegments(geometry(shape.features), line);
    this.edges = new LineSegments(geometry(shape.edges), line);
    for (const each of [this.mesh, this.features, this.edges]) each.frustumCulled = false;
  }
  /** Whether a vertex belongs to a place that is not there. */
  gone(vertex: number): boolean {
    return this.value[vertex] < NONE;
  }
  /** Values at the nodes. What is shown already goes to the graphics card no second time.
   * @param places  a field that is NaN at nodes that are not there */
  setValues(values: Float32Array, places?: Float32Array): void {
    if (values === this.shownValues && places === this.shownPlaces) return;
    this.shownValues = values;
    this.shownPlaces = places;
    const { a, b, t } = this.shape;
    for (let i = 0; i < a.length; ++i) {
      const v = t[i] === 0 ? values[a[i]] : (1 - t[i]) * values[a[i]] + t[i] * values[b[i]];
      const gone = places !== undefined && (Number.isNaN(places[a[i]]) || (t[i] !== 0 && Number.isNaN(places[b[i]])));
      this.value[i] = gone ? GONE : Number.isFinite(v) ? v : NONE;
    }
    this.attributes[1].needsUpdate = true;
  }
  setDisplacement(parts: Float32Array[]): void {
    if (parts.every((part, c) => part === this.shownParts[c])) return;
    this.shownParts = parts;
    const { a, b, t } = this.shape;
    parts.forEach((part, c) => {
      for (let i = 0; i < a.length; ++i) {
        const v = t[i] === 0 ? part[a[i]] : (1 - t[i]) * part[a[i]] + t[i] * part[b[i]];
        this.disp[3 * i + c] = Number.isFinite(v) ? v : 0;
      }
    });
    this.attributes[0].needsUpdate = true;
  }
  dispose(): void {
    for (const each of [this.mesh, this.features, this.edges]) each.geometry.dispose();
  }
}
