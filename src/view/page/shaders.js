// The GLSL programs: the sum of layers, its display, and a grid of samples for the histogram.

export const kMaxLayers = 64;

/// Colours of false colour, one a stop from 7 stops below middle grey on, in sRGB.
export const kFalseColors = [
  [38, 12, 64], [52, 40, 130], [36, 84, 176], [20, 130, 178], [16, 150, 130], [38, 150, 66],
  [92, 92, 92], [150, 150, 150], [206, 192, 80], [226, 150, 40], [222, 92, 34], [200, 34, 40],
  [255, 255, 255]];
export const kFalseColorFirstStop = -7;

const kVertex = `#version 300 es
void main() {
  gl_Position = vec4(gl_VertexID == 1 ? 3.0 : -1.0, gl_VertexID == 2 ? 3.0 : -1.0, 0.0, 1.0);
}`;

const kHead = `#version 300 es
precision highp float;
precision highp int;
precision highp sampler2D;
precision highp sampler2DArray;
`;

const kSum = `${kHead}
uniform sampler2DArray layers;
uniform sampler2DArray scales;  // one texel a tile
uniform int count;
uniform int tile;
uniform bool scalar;
uniform vec3 weights[${kMaxLayers}];
out vec4 sum;

void main() {
  ivec2 pixel = ivec2(gl_FragCoord.xy);
  vec3 total = vec3(0.0);
  for (int layer = 0; layer < count; ++layer) {
    float scale = texelFetch(scales, ivec3(pixel / tile, layer), 0).r;
    vec3 value = texelFetch(layers, ivec3(pixel, layer), 0).rgb;
    total += weights[layer] * (scale * (scalar ? value.rrr : value));
  }
  sum = vec4(total, 1.0);
}`;

const kGrid = `${kHead}
uniform sampler2D picture;
uniform vec2 grid;
out vec4 value;

void main() {
  value = texelFetch(picture, ivec2(gl_FragCoord.xy / grid * vec2(textureSize(picture, 0))), 0);
}`;

// Places are in pixels of the full picture, x to the right and y down. A region is the rectangle
// that a texture covers, which has fewer pixels than the region in coarse pictures.
const kShow = `${kHead}
uniform sampler2D current;
uniform sampler2D other;
uniform sampler2D heat;
uniform vec4 currentRegion;     // x, y, width, height
uniform vec4 otherRegion;
uniform ivec2 currentTop;       // the last texel
uniform ivec2 otherTop;
uniform vec2 frameSize;         // full picture
uniform float canvasHeight;
uniform vec2 origin;            // top left of the picture on the canvas
uniform float zoom;
uniform bool smoothed;
uniform bool hasCurrent;
uniform int compare;            // 0 current, 1 split, 2 other, 3 difference, 4 heat map
uniform float split;            // canvas x
uniform float exposure;
uniform mat3 balance;
uniform int curve;              // 0 sRGB, 1 filmic, 2 false colour
uniform int content;            // 0 light, 1 reflectance, 2 directions, 3 one number
uniform vec2 range;             // sizes of numbers shown as white and black; 0 is black, too
uniform bool marks;
uniform vec3 falseColors[${kFalseColors.length}];
out vec4 color;

// Pictures are told apart by a number, so that the code below is there once.
vec3 texel(int picture, ivec2 at) {
  if (picture == 0) return texelFetch(current, clamp(at, ivec2(0), currentTop), 0).rgb;
  return texelFetch(other, clamp(at, ivec2(0), otherTop), 0).rgb;
}

vec3 bilinear(int picture, vec2 at) {
  vec2 corner = floor(at - 0.5);
  vec2 part = at - 0.5 - corner;
  vec3 total = vec3(0.0);
  for (int i = 0; i < 4; ++i) {
    ivec2 step = ivec2(i & 1, i >> 1);
    vec2 weight = mix(1.0 - part, part, vec2(step));
    total += weight.x * weight.y * texel(picture, ivec2(corner) + step);
  }
  return total;
}

vec3 boxMean(int picture, vec2 at, vec2 width) {
  int n = clamp(int(ceil(max(width.x, width.y))), 1, 8);
  vec3 total = vec3(0.0);
  for (int i = 0; i < n * n; ++i) {
    vec2 offset = (vec2(i % n, i / n) + 0.5) / float(n) - 0.5;
    total += texel(picture, ivec2(floor(at + offset * width)));
  }
  return total / float(n * n);
}

bool inside(vec4 region, vec2 place) {
  return all(greaterThanEqual(place, region.xy)) && all(lessThan(place, region.xy + region.zw));
}

vec3 look(int picture, vec2 place) {
  vec4 region = picture == 0 ? currentRegion : otherRegion;
  vec2 size = vec2((picture == 0 ? currentTop : otherTop) + 1);
  vec2 density = size / region.zw;  // texels a pixel of the full picture
  vec2 at = (place - region.xy) * density;
  vec2 width = density / zoom;
  if (width.x > 1.001) return boxMean(picture, at, width);
  if (content < 2 && (smoothed || density.x < 0.99)) return bilinear(picture, at);
  return texel(picture, ivec2(floor(at)));
}

vec3 encode(vec3 v) {
  v = clamp(v, 0.0, 1.0);
  return mix(12.92 * v, 1.055 * pow(v, vec3(1.0 / 2.4)) - 0.055, step(0.0031308, v));
}

// Narkowicz 2015, a fit of the ACES curve.
vec3 filmic(vec3 v) {
  v = max(v, 0.0);
  return (v * (2.51 * v + 0.03)) / (v * (2.43 * v + 0.59) + 0.14);
}

vec3 falseColor(vec3 v) {
  float stops = log2(max(dot(v, vec3(0.2126, 0.7152, 0.0722)), 1e-9) / 0.18);
  int step = int(floor(stops + 0.5)) - (${kFalseColorFirstStop});
  return falseColors[clamp(step, 0, ${kFalseColors.length - 1})];
}

bool finite(vec3 v) {
  return !any(isnan(v)) && !any(isinf(v));
}

vec3 showLight(vec3 linear) {
  vec3 v = balance * (linear * exposure);
  bool zebra = mod(gl_FragCoord.x + gl_FragCoord.y, 8.0) < 4.0;
  if (marks && zebra && curve != 2) {
    float low = min(v.r, min(v.g, v.b));
    float high = max(v.r, max(v.g, v.b));
    if (high > 1.0) return vec3(1.0, 0.15, 0.1);
    if (low < -1e-4) return vec3(1.0, 0.2, 1.0);
    if (high <= 0.0003) return vec3(0.15, 0.35, 1.0);
  }
  if (curve == 2) return falseColor(v);
  return encode(curve == 1 ? filmic(v) : v);
}

vec3 show(vec3 v) {
  if (!finite(v)) return marks ? vec3(0.0, 1.0, 0.0) : vec3(0.0);
  if (content == 1) return encode(v);
  if (content == 2) return 0.5 * v + 0.5;
  if (content == 3) {
    float size = abs(v.r);
    return vec3(size > 0.0 ? clamp((size - range.y) / (range.x - range.y), 0.0, 1.0) : 0.0);
  }
  return showLight(v);
}

void main() {
  vec2 canvas = vec2(gl_FragCoord.x, canvasHeight - gl_FragCoord.y);
  vec2 place = (canvas - origin) / zoom;
  color = vec4(vec3(0.07), 1.0);
  if (!hasCurrent || !inside(vec4(vec2(0.0), frameSize), place)) return;
  color.rgb = vec3(0.035);
  if (compare == 4) {
    if (!inside(otherRegion, place)) return;
    color.rgb = texture(heat, (place - otherRegion.xy) / otherRegion.zw).rgb;
    return;
  }
  int first = compare == 2 || (compare == 1 && canvas.x < split) ? 1 : 0;
  int last = compare == 3 ? 1 : first;
  vec3 value = vec3(0.0);
  for (int picture = first; picture <= last; ++picture) {
    if (!inside(picture == 0 ? currentRegion : otherRegion, place)) return;
    value = look(picture, place) - value;
  }
  color.rgb = show(compare == 3 ? abs(value) : value);
}`;

/// A linked program and the places of its uniforms: {program, at: {name: location}}.
function link(gl, fragment) {
  const program = gl.createProgram();
  for (const [type, source] of [[gl.VERTEX_SHADER, kVertex], [gl.FRAGMENT_SHADER, fragment]]) {
    const shader = gl.createShader(type);
    gl.shaderSource(shader, source);
    gl.compileShader(shader);
    gl.attachShader(program, shader);
    if (!gl.getShaderParameter(shader, gl.COMPILE_STATUS) && !gl.isContextLost()) {
      throw new Error(`shader: ${gl.getShaderInfoLog(shader)}`);
    }
  }
  gl.linkProgram(program);
  const at = {};
  const count = gl.getProgramParameter(program, gl.ACTIVE_UNIFORMS) ?? 0;
  for (let i = 0; i < count; ++i) {
    const name = gl.getActiveUniform(program, i).name.replace('[0]', '');
    at[name] = gl.getUniformLocation(program, name);
  }
  return { program, at };
}

export function linkPrograms(gl) {
  return { sum: link(gl, kSum), grid: link(gl, kGrid), show: link(gl, kShow) };
}
