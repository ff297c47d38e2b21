/** Brings a scene to the screen: with smooth edges, or, while something moves on a slow machine, fast. */
import {
  Camera, GLSL3, Mesh, NoBlending, OrthographicCamera, PlaneGeometry, Scene, ShaderMaterial, Vector2, WebGLRenderer, WebGLRenderTarget,
} from "three";

/** A picture that takes longer than this is not drawn again for every move [ms]. */
const SLOW = 40;
/** So long after the last move a draft gives way to the picture [ms]. */
const REST = 180;

/** A picture has four samples a pixel. The first one has a single sample, to come soon; a draft, made while something moves where
 * pictures are slow, has one for four pixels. */
export class Painter {
  /** Triangles of the last picture or draft. */
  triangles = 0;
  private readonly samples = new WebGLRenderTarget(1, 1, { samples: 4 });
  private readonly copy = new Scene();
  private readonly straight = new OrthographicCamera();
  private readonly ratio = Math.min(2, window.devicePixelRatio || 1);
  private rest = 0;
  private pictures = 0;
  private cost = 0;

  constructor(private readonly renderer: WebGLRenderer) {
    renderer.setPixelRatio(this.ratio);
    const material = new ShaderMaterial({
      glslVersion: GLSL3, depthTest: false, depthWrite: false, blending: NoBlending, uniforms: { picture: { value: this.samples.texture } },
      vertexShader: "void main() { gl_Position = vec4(position.xy, 0.0, 1.0); }",
      fragmentShader: "uniform sampler2D picture; out vec4 colour; void main() { colour = texelFetch(picture, ivec2(gl_FragCoord.xy), 0); }",
    });
    const whole = new Mesh(new PlaneGeometry(2, 2), material);
    whole.frustumCulled = false;
    this.copy.add(whole);
  }

  /** Whether pictures of things that move are drafts. */
  get slow(): boolean {
    return this.cost > SLOW;
  }

  /** Whether the last picture has shown that the machine draws another one for every move; not before a picture was timed. */
  get quick(): boolean {
    return this.cost > 0 && !this.slow;
  }
  /** What is drawn has changed: the next picture says anew how long one takes. */
  forget(): void {
    this.cost = 0;
  }

  /** Draws a draft where pictures are slow and something is `moving`, and where only a `rough` copy is drawn; `settle` is called when it is
   * time for the picture. */
  paint(scene: Scene, camera: Camera, moving: boolean, settle: () => void, rough = false): void {
    clearTimeout(this.rest);
    const draft = rough || (moving && this.slow);
    this.setRatio(draft ? this.ratio / 2 : this.ratio);
    if (draft || this.pictures++ === 0) {
      this.renderer.render(scene, camera);
      this.triangles = this.renderer.info.render.triangles;
      this.rest = window.setTimeout(settle, REST);
      return;
    }
    const began = performance.now();
    const size = this.renderer.getDrawingBufferSize(new Vector2());
    this.samples.setSize(size.x, size.y);
    this.renderer.setRenderTarget(this.samples);
    this.renderer.render(scene, camera);
    this.triangles = this.renderer.info.render.triangles;
    this.renderer.setRenderTarget(null);
    this.renderer.render(this.copy, this.straight);
    this.time(began);
  }

  private setRatio(ratio: number): void {
    if (this.renderer.getPixelRatio() !== ratio) this.renderer.setPixelRatio(ratio);
  }

  /** Looks when the graphics card, or the processor in its stead, is done. The first of these pictures, for which it compiles shaders, says nothing. */
  private time(began: number): void {
    if (this.pictures === 2) return;
    const gl = this.renderer.getContext() as WebGL2RenderingContext;
    const fence = gl.fenceSync(gl.SYNC_GPU_COMMANDS_COMPLETE, 0);
    if (!fence) return;
    gl.flush();
    const look = () => {
      if (gl.getSyncParameter(fence, gl.SYNC_STATUS) !== gl.SIGNALED && !gl.isContextLost()) {
        setTimeout(look, 2);
        return;
      }
      this.cost = performance.now() - began;
      gl.deleteSync(fence);
    };
    setTimeout(look, 2);
  }
}
