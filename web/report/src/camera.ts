/** A camera without perspective that turns about a target: distances can be measured on the screen. */
import { OrthographicCamera, Quaternion, Vector3 } from "three";

export class Camera {
  readonly three = new OrthographicCamera(-1, 1, 1, -1, -10, 10);
  target = new Vector3();
  turn = new Quaternion();
  /** Metres from the target to the upper edge. */
  half = 1;
  /** Radius of everything, for the near and far planes. */
  reach = 1;
  flat = false;
  /** What is up on the screen: z of a solid, against gravity; y of a section, also where it is turned about it. */
  readonly up = new Vector3(0, 1, 0);

  /** Where one looks from at first: the right, the front and above. */
  get corner(): [number, number, number] {
    return this.up.z > 0 ? [0.55, -0.75, 0.45] : [0.55, 0.45, 0.75];
  }
  apply(width: number, height: number): void {
    const aspect = width / Math.max(1, height), c = this.three;
    c.left = -this.half * aspect;
    c.right = this.half * aspect;
    c.top = this.half;
    c.bottom = -this.half;
    const far = 4 * this.reach + this.half;
    c.near = -far;
    c.far = far;
    c.position.copy(this.target);
    c.quaternion.copy(this.turn);
    c.updateProjectionMatrix();
    c.updateMatrixWorld();
  }
  /** By pixels of a drag. */
  rotate(dx: number, dy: number): void {
    const right = new Vector3(1, 0, 0).applyQuaternion(this.turn);
    this.turn.premultiply(new Quaternion().setFromAxisAngle(right, -dy * 0.008));
    this.turn.premultiply(new Quaternion().setFromAxisAngle(this.up, -dx * 0.008)).normalize();
  }
  pan(dx: number, dy: number, height: number): void {
    const metres = (2 * this.half) / height;
    this.target.add(new Vector3(-dx * metres, dy * metres, 0).applyQuaternion(this.turn));
  }
  /** Keeps what lies under the pointer (−1 … 1 across and up) where it is. */
  zoom(factor: number, px: number, py: number, aspect: number): void {
    const before = this.half;
    this.half = Math.min(Math.max(this.half * factor, this.reach * 1e-3), this.reach * 20);
    const shift = before - this.half;
    this.target.add(new Vector3(px * aspect * shift, py * shift, 0).applyQuaternion(this.turn));
  }
  look(direction: [number, number, number]): void {
    const d = new Vector3(...direction).normalize();
    const along = d.dot(this.up), level = this.up.z > 0 ? new Vector3(0, 1, 0) : new Vector3(0, 0, -1);
    const up = Math.abs(along) > 0.99 ? level.multiplyScalar(Math.sign(along)) : this.up;
    const right = up.clone().cross(d).normalize();
    const trueUp = d.clone().cross(right);
    const m = new OrthographicCamera().matrix.makeBasis(right, trueUp, d);
    this.turn.setFromRotationMatrix(m);
  }
}
