// Numbers as people read them.

/// Three to four digits: 0.0123, 12.3, 1.2e-5.
export function formatValue(value) {
  if (!Number.isFinite(value)) return String(value);
  const size = Math.abs(value);
  if (Number.isInteger(value) && size < 1e5) return String(value);
  if (size < 1e-3 || size >= 1e5) return value.toExponential(2);
  return value.toPrecision(size >= 1000 ? 4 : 3);
}

export function formatColor(rgb) {
  return rgb.map(formatValue).join('  ');
}

/// "1 pass", "2 passes", "12 k samples".
export function formatNumberOf(count, one, many) {
  return `${formatCount(count)} ${count === 1 ? one : many}`;
}

/// 0.0312 as "3.1 %".
export function formatShare(share) {
  const percent = 100 * share;
  if (Math.abs(percent) >= 99.95) return `${percent.toFixed(0)} %`;
  return `${percent.toFixed(Math.abs(percent) < 1 ? 2 : 1)} %`;
}

/// 2100000 as "2.1 M".
export function formatCount(count) {
  if (count >= 1e9) return `${(count / 1e9).toFixed(1)} G`;
  if (count >= 1e6) return `${(count / 1e6).toFixed(1)} M`;
  if (count >= 1e4) return `${(count / 1e3).toFixed(0)} k`;
  return String(Math.round(count));
}

/// Seconds as "3.2 s", "4 min 05 s" or "2 h 10 min".
export function formatDuration(seconds) {
  if (seconds < 60) return `${seconds.toFixed(seconds < 10 ? 1 : 0)} s`;
  const whole = Math.round(seconds);
  const two = (number) => String(number).padStart(2, '0');
  if (whole < 3600) return `${Math.floor(whole / 60)} min ${two(whole % 60)} s`;
  return `${Math.floor(whole / 3600)} h ${two(Math.floor((whole % 3600) / 60))} min`;
}

export function formatStops(stops) {
  return `${stops > 0 ? '+' : stops < 0 ? '−' : ''}${Math.abs(stops).toFixed(2)}`;
}

export function luminance([r, g, b]) {
  return 0.2126 * r + 0.7152 * g + 0.0722 * b;
}
