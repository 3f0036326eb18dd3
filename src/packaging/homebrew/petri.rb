class Petri < Formula
  desc "Fast, deterministic interpreter for Flitter scripts with particle physics"
  homepage "@HOMEPAGE@"
  url "@RELEASES@/v@VERSION@/petri-@VERSION@.tar.xz"
  sha256 "@SHA256@"
  license "MIT"

  depends_on "meson" => :build
  depends_on "ninja" => :build
  depends_on "pkgconf" => :build
  depends_on "xxhash" => :build
  depends_on "cairo"
  depends_on "chafa"
  depends_on "hdf5"
  depends_on "jpeg-turbo"
  depends_on "libepoxy"
  depends_on "libpng"
  depends_on "libyaml"
  depends_on "pango"
  depends_on "sdl2"
  uses_from_macos "libedit"
  uses_from_macos "sqlite"
  uses_from_macos "zlib"

  def install
    system "meson", "setup", "build", "-Dtests=false", "-Dpython=disabled", "-Dmpi=disabled", *std_meson_args
    system "meson", "compile", "-C", "build"
    system "meson", "install", "-C", "build", "--no-rebuild"
  end

  test do
    system bin/"petri", "new", "dish"
    assert_match(/^= [0-9a-f]{64}$/, shell_output("#{bin}/petri run dish.fl --frames 2 --print hash"))
    assert_match version.to_s, shell_output("#{bin}/petri --version")
  end
end
