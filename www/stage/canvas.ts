/** A canvas that is as sharp as the screen, and knows its size in CSS pixels. */

import type { Box } from "./place";

export class SharpCanvas {
  readonly context: CanvasRenderingContext2D;
  size: Box = { width: 0, height: 0 };
  private waiting = false;

  /** `draw` begins by clearing, unless it would rather leave what is there. */
  constructor(
    readonly element: HTMLCanvasElement,
    private readonly draw: (context: CanvasRenderingContext2D, size: Box) => void,
  ) {
    this.context = element.getContext("2d")!;
    new ResizeObserver(() => this.fit()).observe(element.parentElement!);
    this.fit();
  }

  /** Draws at the next display refresh, once, however often it is asked. */
  invalidate(): void {
    if (this.waiting) return;
    this.waiting = true;
    requestAnimationFrame(() => {
      this.waiting = false;
      this.paint();
    });
  }

  private fit(): void {
    const { clientWidth: width, clientHeight: height } = this.element.parentElement!;
    const dense = window.devicePixelRatio || 1;
    this.size = { width, height };
    this.element.width = Math.round(width * dense);
    this.element.height = Math.round(height * dense);
    this.paint();
  }

  private paint(): void {
    const { width, height } = this.size;
    if (width === 0 || height === 0) return;
    const dense = this.element.width / width;
    this.context.setTransform(dense, 0, 0, dense, 0, 0);
    this.draw(this.context, this.size);
  }
}
