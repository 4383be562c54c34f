#!/usr/bin/env bash
# kubernetes_test.sh: the test of the example for Kubernetes, which needs no cluster.
set -euo pipefail
here=$(cd "$(dirname "${BASH_SOURCE[0]}")" && pwd)
source "$here/../support/require_modules.sh"
require_modules jsonschema=python3-jsonschema yaml=python3-yaml
exec /usr/bin/python3 -B "$here/kubernetes_example_test.py"
