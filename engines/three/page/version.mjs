/** The version of the npm package, of the REVISION that three.js calls itself. */
export function versionOf(revision) {
  return `0.${revision}.0`;
}
