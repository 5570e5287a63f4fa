"""Settings of the documentation site: Sphinx, without any request to the network."""

from __future__ import annotations

import sys
from pathlib import Path

ROOT = Path(__file__).resolve().parents[1]
sys.path.insert(0, str(ROOT / "python"))

from matplotlib.figure import Figure  # noqa: E402
from sphinx_gallery.scrapers import figure_rst  # noqa: E402

import seismass  # noqa: E402

project = "seismass"
author = "The seismass authors"
copyright = author
version = release = seismass.__version__

extensions = [
    "myst_parser",
    "numpydoc",
    "sphinx.ext.autodoc",
    "sphinx.ext.autosummary",
    "sphinx_gallery.gen_gallery",
]
source_suffix = {".rst": "restructuredtext", ".md": "markdown"}
templates_path = ["_templates"]
exclude_patterns = ["_build", "gallery"]
nitpicky = False

# Markdown: headings are anchors, so that links to sections are checked.
myst_heading_anchors = 4
myst_enable_extensions = ["colon_fence"]

autosummary_generate = True
autosummary_imported_members = False
autodoc_typehints = "none"
autodoc_member_order = "groupwise"
toc_object_entries_show_parents = "hide"
numpydoc_show_class_members = False
numpydoc_class_members_toctree = False
numpydoc_xref_param_type = False

html_theme = "pydata_sphinx_theme"
html_title = "seismass"
html_context = {"default_mode": "auto"}
html_static_path = ["_static"]
html_css_files = ["site.css"]
html_copy_source = False
html_show_sourcelink = False
html_theme_options = {
    "show_prev_next": True,
    "navigation_with_keys": False,
    "header_links_before_dropdown": 7,
    "secondary_sidebar_items": ["page-toc"],
    "footer_start": ["copyright"],
    "footer_end": [],
    "icon_links": [],
    "use_edit_page_button": False,
}
# Search, theme and fonts are files of the site itself.
html_sidebars = {"index": [], "cite": [], "changelog": []}


def figures(block, block_vars, gallery_conf):
    """Save the figure that a block of an example ends with, as a notebook shows it; figures need no pyplot."""
    last = block_vars["example_globals"].get("___")
    if not isinstance(last, Figure) or getattr(last, "_in_gallery", False):
        return ""
    last._in_gallery = True  # `___` is the last value so far
    path = next(block_vars["image_path_iterator"])
    last.savefig(path, dpi=120)
    return figure_rst([path], gallery_conf["src_dir"])


sphinx_gallery_conf = {
    "examples_dirs": ["gallery"],
    "gallery_dirs": ["examples"],
    "filename_pattern": r"\.py$",
    "ignore_pattern": r"__init__\.py",
    "download_all_examples": False,
    "write_computation_times": False,
    "show_memory": False,
    "show_signature": False,
    "remove_config_comments": True,
    "min_reported_time": 10_000,
    "abort_on_example_error": True,
    "capture_repr": ("_repr_html_", "__repr__"),
    "image_scrapers": (figures,),
    "ignore_repr_types": r"matplotlib\.figure",
    "reset_modules": (),
    "notebook_images": False,
    "within_subsection_order": "FileNameSortKey",
    "doc_module": ("seismass",),
    "backreferences_dir": None,
    "inspect_global_variables": False,
    "default_thumb_file": str(ROOT / "docs" / "figures" / "effective_fraction.png"),
}
# Links are checked by tools/check_links.py, in a folder whose path has a space too.
suppress_warnings = ["config.cache", "sphinx_gallery.space_in_filename"]
