// Copyright 2026 The amr_description authors
// SPDX-License-Identifier: Apache-2.0
/** What the browser can draw with. */

/** WebGL 2 is missing. The message is for the person before the page. */
export class NoWebGL extends Error {
  override readonly name = 'NoWebGL';

  constructor() {
    super(
      'This browser offers no WebGL 2, so the 3-D view is off; everything else works. ' +
        'Turn on hardware acceleration in its settings, or try another browser.',
    );
  }
}

/**
 * Whether pixels are drawn by the processor (SwiftShader, llvmpipe …), where each one counts.
 *
 * Throws {@link NoWebGL} where nothing draws. Asked of a canvas of its own, since a canvas keeps
 * the settings of its first context.
 */
export function isSoftwareDrawn(): boolean {
  const gl = document.createElement('canvas').getContext('webgl2');
  if (gl === null) {
    throw new NoWebGL();
  }
  const info = gl.getExtension('WEBGL_debug_renderer_info');
  const name = String(gl.getParameter(info ? info.UNMASKED_RENDERER_WEBGL : gl.RENDERER));
  gl.getExtension('WEBGL_lose_context')?.loseContext();
  return /swiftshader|llvmpipe|softpipe|software|basic render/i.test(name);
}
