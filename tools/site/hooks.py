"""What MkDocs does not do by itself for this tree; mkdocs.yml names it under `hooks`.

The site has the layout of the tree, so that one relative link holds on GitHub, in an editor and on the site: README.md is
the first page, docs/ keeps its name. Source files and folders that pages link to become pages of the site.
"""

import html
import logging
import pathlib
import posixpath
import re
import sys

sys.dont_write_bytecode = True
TOOLS = pathlib.Path(__file__).resolve().parents[1]
sys.path[:0] = [str(TOOLS), str(TOOLS / "site")]

from mkdocs.structure.files import File, Files
from mkdocs.structure.nav import Link

from check_documents import is_page, tracked_files
from documents.links import resolve
from documents.page import read_page
from github_lists import as_python_markdown
from navigation import expand

ROOT = TOOLS.parent
API = "api/index.html"
PICTURES = (".png", ".svg")
LANGUAGES = {".h": "cpp", ".cpp": "cpp", ".py": "python", ".sh": "bash", ".json": "json", ".cmake": "cmake", ".fbs": "c",
             ".urdf": "xml", ".yml": "yaml", ".txt": "text"}
log = logging.getLogger("mkdocs.cairn")


class GeneratedPage(File):
    """A page made of a source file or a folder of the tree."""

    def __init__(self, name, destination, text, config):
        super().__init__(name, str(ROOT), config["site_dir"], use_directory_urls=False)
        self.dest_uri = destination
        self.url = destination
        self.abs_dest_path = str(pathlib.Path(config["site_dir"], destination))
        self.text = text

    def is_documentation_page(self):
        return True


def page_of_source(name, config):
    text = (ROOT / name).read_text(encoding="utf-8")
    if name.endswith(".md"):
        return GeneratedPage(name, name + ".html", as_python_markdown(text), config)
    language = LANGUAGES.get(pathlib.PurePosixPath(name).suffix, "text")
    longest = max((len(run) for run in re.findall(r"`+", text)), default=0)
    fence = "`" * max(3, longest + 1)
    return GeneratedPage(name, name + ".html", f"# {name}\n\n{fence}{language}\n{text.rstrip()}\n{fence}\n", config)


def page_of_folder(name, inside, config):
    own = posixpath.basename(name)  # links are read as from the folder above
    links = "\n".join(f"- [{child}]({own}/{child})" for child in inside)
    return GeneratedPage(name, f"{name}/index.html", f"# {name}/\n\n{links}\n", config)


def index_of(folder):
    """The page that stands for a folder, where it has one."""
    return posixpath.join(folder, "README.md")


def linked_names(names):
    """Files and folders that pages link to and that are no pages themselves, with the files in such folders."""
    files, folders = set(), set()
    for page in filter(is_page, names):
        for link in read_page((ROOT / page).read_text(encoding="utf-8")).links:
            resolved = resolve(page, link.target)
            if resolved and not link.is_image and (ROOT / resolved[0]).is_dir():
                folders.add(resolved[0])
            elif resolved and resolved[0] in names and not is_page(resolved[0]):
                files.add(resolved[0])
    return files, folders


def on_config(config):
    nav, problems = expand(config["nav"], [name for name in tracked_files(ROOT) if is_page(name)])
    for problem in problems:
        log.warning(problem)
    config["nav"] = nav
    return config


def on_files(files, config):
    names = set(tracked_files(ROOT))
    docs = str(pathlib.Path(config["docs_dir"]))
    ours = [file for file in files if not file.abs_src_path.startswith(docs)]  # the theme's own
    ours.append(File("site.css", str(TOOLS / "site"), config["site_dir"], False))
    linked, folders = linked_names(names)
    for folder in sorted(folder for folder in folders if index_of(folder) not in names):
        inside = sorted(name for name in names if posixpath.dirname(name) == folder)
        linked.update(name for name in inside if not is_page(name))
        ours.append(page_of_folder(folder, [posixpath.basename(name) for name in inside], config))
    shown = [name for name in sorted(names) if is_page(name) or name.startswith("docs/images/")]
    ours += [File(name, str(ROOT), config["site_dir"], False) for name in shown]
    ours += [page_of_source(name, config) for name in sorted(linked) if not name.endswith(PICTURES)]
    return Files(ours)


def on_nav(nav, config, files):
    nav.items.append(Link("API", API))
    return nav


def on_page_read_source(page, config):
    return page.file.text if isinstance(page.file, GeneratedPage) else None


def on_page_markdown(markdown, page, config, files):
    return markdown if isinstance(page.file, GeneratedPage) else as_python_markdown(markdown)


def on_page_content(content, page, config, files):
    """MkDocs turns links to files whose names have a dot. Here follow those to folders and to files like LICENSE."""
    here = posixpath.dirname(page.file.src_uri)

    def mend(found):
        name = posixpath.normpath(posixpath.join(here, html.unescape(found.group(1))))
        file = files.get_file_from_path(index_of(name)) or files.get_file_from_path(name)
        if file is None or not file.is_documentation_page():
            return found.group(0)
        return f'href="{posixpath.relpath(file.url, posixpath.dirname(page.file.url) or ".")}"'

    content = re.sub(r'href="([^"#:]+)"', mend, content)
    return re.sub(r"<code>([^<\s]{1,30})</code>", r'<code class="word">\1</code>', content)  # not to be broken at a hyphen
