#!/usr/bin/env bash
# Fetches the headers of one MeshLab version (its own and vcglib's) from the source that Debian publishes: no MeshLab
# has a development package. Needs dpkg and apt, but not root: it keeps apt's state in a folder of its own.
#
#   fetch_headers.sh VERSION DIR      VERSION is 2020.09, 2022.02 or 2025.07; DIR gets src/ and vcglib/
#
# DEBIAN_MIRROR=URL takes it from there. Exit code 3: Debian no longer has that version (only its releases stay; 2025.07
# is from its testing suite). 4: it could not be asked.
set -euo pipefail

version=$1 out=$2
case $version in
    2020.09) suite=bookworm sum=d6715352ff65caffdec0292858d4263eb0c3cbbf3b1e5c2e2bab218e3f234630 ;;
    2022.02) suite=trixie sum=11da26ec46c3fbbbc806d410a3221542ec21ec13fdcc55d624304600029435fd ;;
    2025.07) suite=forky sum=d22c98d362f2a284e481af8dbfc272b2222f5b9c67b3cf8bec57d1c3161886f4 ;;
    *) echo "fetch_headers.sh: no headers known for MeshLab $version" >&2 && exit 2 ;;
esac
if [[ -f $out/sha256 && $(<"$out/sha256") == "$sum" ]]; then
    exit
fi

work=$(mktemp -d)
trap 'rm -rf "$work"' EXIT
mkdir -p "$work"/{lists/partial,cache/archives/partial,source}
touch "$work/status"
mirror=${DEBIAN_MIRROR:-http://deb.debian.org/debian}
key=/usr/share/keyrings/debian-archive-keyring.gpg
echo "deb-src [signed-by=$key] $mirror $suite main" >"$work/sources.list"
options=(
    -o Dir::State::lists="$work/lists" -o Dir::State::status="$work/status" -o Dir::Cache="$work/cache"
    -o Dir::Etc::SourceList="$work/sources.list" -o Dir::Etc::SourceParts=- -o APT::Sandbox::User=
    -o APT::Update::Post-Invoke-Success::= -o Acquire::Check-Valid-Until=false
    -o APT::Update::Error-Mode=any -o Acquire::Retries=3
)

gone() {
    echo "fetch_headers.sh: $1" >&2
    exit 3
}
# Runs apt. A file that is not there ends in `gone`, all else in an error that says what to do.
apt() {
    (cd "$work/source" && LC_ALL=C apt-get -qq "${options[@]}" "$@") 2>"$work/errors" && return
    cat "$work/errors" >&2
    ! grep -qE '404 +Not Found|not have a Release file|Unable to find a source package' "$work/errors" ||
        gone "Debian $suite does not have the source of MeshLab"
    echo "fetch_headers.sh: the source of MeshLab $version could not be fetched from $mirror. Check the network and try" \
        "again; or name another mirror with DEBIAN_MIRROR=URL" >&2
    exit 4
}
apt update
# Only the tar ball: what else belongs to a source package goes away when the next one comes.
apt source --only-source --tar-only --download-only meshlab
tarball=("$work"/source/meshlab_*.orig.tar.*)
if ! echo "$sum  ${tarball[0]}" | sha256sum --quiet --check >&2; then
    gone "$(basename "${tarball[0]}") of Debian $suite is not the source of MeshLab $version"
fi

mkdir "$work/tree"
tar -xf "${tarball[0]}" -C "$work/tree" --strip-components=1 --wildcards --no-anchored '*.h' '*.hpp' '*/vcglib/vcg/*' \
    '*/vcglib/wrap/*' '*/src/common/*'
vcglib=$work/tree/vcglib
[[ -d $vcglib ]] || vcglib=$work/tree/src/vcglib
rm -rf "$out"
mkdir -p "$out/src" "$out/vcglib"
cp -r "$work/tree/src/common" "$out/src/"
cp -r "$vcglib/vcg" "$vcglib/wrap" "$out/vcglib/"
echo "$sum" >"$out/sha256"
