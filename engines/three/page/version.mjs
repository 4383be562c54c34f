/** The version of the npm package for three.js's REVISION. */
export function versionOf(revision) {
  return `0.${revision}.0`;
}
