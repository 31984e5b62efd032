#!/bin/sh
# run_node.sh WEB_FOLDER NODE_ARGUMENTS...: runs node on the report's page, or tells ctest (exit code 77) to report the
# test as skipped where what it needs is not installed. ./test installs all of it.
web=$1
shift
skip() {
  echo "skipped: $1; ./test installs what this test needs"
  exit 77
}
command -v node >/dev/null || skip "node is not installed"
node -e 'process.exit(Number(process.versions.node.split(".")[0]) >= 18 ? 0 : 1)' || skip "node is older than version 18"
[ -d "$web/node_modules/esbuild" ] && [ -d "$web/node_modules/playwright-core" ] ||
  skip "the packages of $web/package-lock.json are not installed"
case $* in
*browser*) [ -x "${CHROMIUM:-/usr/bin/chromium}" ] || skip "chromium is not installed" ;;
esac
exec node "$@"
