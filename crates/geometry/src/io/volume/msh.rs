use std::collections::{BTreeMap, HashMap};

use super::super::text::{number, unexpected};
use super::RawVolume;
use super::words::{Lines, count, integer};
use crate::{ReadFault, Vec3};

const TETRAHEDRON: i64 = 4;
const QUADRATIC_TETRAHEDRON: i64 = 11;

/// Points, lines, triangles and quadrangles of all orders.
const FLAT: [i64; 21] = [
    1, 2, 3, 8, 9, 10, 15, 16, 20, 21, 22, 23, 24, 25, 26, 27, 28, 36, 37, 38, 62,
];

/// Which of the two ways the numbers stand.
#[derive(Debug, Clone, Copy, PartialEq, Eq)]
enum Version {
    Two,
    Four,
}

#[derive(Debug, Default)]
struct Msh {
    volume: RawVolume,
    /// Position of a node by its number in the file. Never walked over.
    places: HashMap<i64, u32>,
    /// First physical group of each volume of a file of version 4.
    groups: BTreeMap<i64, i64>,
    cells: usize,
}

pub(super) fn read(text: &str) -> Result<RawVolume, ReadFault> {
    let mut lines = Lines::new(text);
    let (line, first) = lines.next("`$MeshFormat`")?;
    if first != "$MeshFormat" {
        return Err(unexpected(line, first, "`$MeshFormat`"));
    }
    let version = version(&mut lines)?;
    end(&mut lines, "`$EndMeshFormat`")?;
    let mut msh = Msh::default();
    while let Some((line, section)) = lines.try_next() {
        match (section, version) {
            ("$PhysicalNames", _) => msh.names(&mut lines)?,
            ("$Entities", Version::Four) => msh.entities(&mut lines)?,
            ("$Nodes", Version::Two) => msh.nodes_2(&mut lines)?,
            ("$Nodes", Version::Four) => msh.nodes_4(&mut lines)?,
            ("$Elements", Version::Two) => msh.elements_2(&mut lines)?,
            ("$Elements", Version::Four) => msh.elements_4(&mut lines)?,
            _ if section.starts_with('$') => {
                pass_over(&mut lines, section)?;
                continue;
            }
            _ => return Err(unexpected(line, section, "the beginning of a section")),
        }
        let expected = match section {
            "$PhysicalNames" => "`$EndPhysicalNames`",
            "$Entities" => "`$EndEntities`",
            "$Nodes" => "`$EndNodes`",
            _ => "`$EndElements`",
        };
        end(&mut lines, expected)?;
    }
    Ok(msh.volume)
}

fn version(lines: &mut Lines<'_>) -> Result<Version, ReadFault> {
    let (line, content) = lines.next("a version")?;
    let mut words = content.split_ascii_whitespace();
    let version = match words.next() {
        Some("2" | "2.0" | "2.1" | "2.2") => Version::Two,
        Some("4.1") => Version::Four,
        other => {
            let found = other.unwrap_or("");
            return Err(unexpected(line, found, "version 2.2 or 4.1 of the format"));
        }
    };
    match words.next() {
        Some("0") => Ok(version),
        Some("1") => Err(ReadFault::UnreadEncoding {
            what: "a binary MSH file",
            remedy: "save it as ASCII (in Gmsh: Mesh.Binary = 0)",
        }),
        other => Err(unexpected(line, other.unwrap_or(""), "0 for ASCII")),
    }
}

fn end(lines: &mut Lines<'_>, expected: &'static str) -> Result<(), ReadFault> {
    let (line, found) = lines.next(expected)?;
    if found == expected.trim_matches('`') {
        Ok(())
    } else {
        Err(unexpected(line, found, expected))
    }
}

fn pass_over(lines: &mut Lines<'_>, section: &str) -> Result<(), ReadFault> {
    let name = &section[1..];
    loop {
        let (_, line) = lines.next("the end of a section")?;
        if line.strip_prefix("$End") == Some(name) {
            return Ok(());
        }
    }
}

impl Msh {
    /// Dimension, number and name of each physical group.
    fn names(&mut self, lines: &mut Lines<'_>) -> Result<(), ReadFault> {
        let (line, words) = lines.next("a number of names")?;
        for _ in 0..count(Some(words), line, "a number of names")? {
            let (line, content) = lines.next("a name of a physical group")?;
            let mut words = content.splitn(3, |c: char| c.is_ascii_whitespace());
            let dimension = integer(words.next(), line, "the dimension of a physical group")?;
            let number = integer(words.next(), line, "the number of a physical group")?;
            let name = words.next().unwrap_or("").trim().trim_matches('"');
            if dimension == 3 && !name.is_empty() {
                self.volume.names.insert(number, name.to_owned());
            }
        }
        Ok(())
    }

    /// Points, curves, surfaces and volumes; a volume has a number, six bounds and its physical groups.
    fn entities(&mut self, lines: &mut Lines<'_>) -> Result<(), ReadFault> {
        let (line, content) = lines.next("four numbers of entities")?;
        let mut words = content.split_ascii_whitespace();
        let mut next = || count(words.next(), line, "four numbers of entities");
        let [points, curves, surfaces, volumes] = [next()?, next()?, next()?, next()?];
        let others = points.saturating_add(curves).saturating_add(surfaces);
        for _ in 0..others {
            lines.next("an entity")?;
        }
        for _ in 0..volumes {
            let (line, content) = lines.next("a volume")?;
            let mut words = content.split_ascii_whitespace();
            let number = integer(words.next(), line, "the number of a volume")?;
            let mut words = words.skip(6);
            if count(words.next(), line, "a number of physical groups")? > 0 {
                let group = integer(words.next(), line, "the number of a physical group")?;
                self.groups.insert(number, group);
            }
        }
        Ok(())
    }

    fn nodes_2(&mut self, lines: &mut Lines<'_>) -> Result<(), ReadFault> {
        let (line, words) = lines.next("a number of nodes")?;
        for _ in 0..count(Some(words), line, "a number of nodes")? {
            let (line, content) = lines.next("a node")?;
            let mut words = content.split_ascii_whitespace();
            let tag = integer(words.next(), line, "the number of a node")?;
            self.add_node(tag, point(words, line)?, line)?;
        }
        Ok(())
    }

    fn nodes_4(&mut self, lines: &mut Lines<'_>) -> Result<(), ReadFault> {
        for _ in 0..blocks(lines)? {
            let [_, _, _, nodes] = block(lines)?;
            let mut tags = Vec::new();
            for _ in 0..nodes {
                let (line, word) = lines.next("the number of a node")?;
                tags.push(integer(Some(word), line, "the number of a node")?);
            }
            for tag in tags {
                let (line, content) = lines.next("a node")?;
                self.add_node(tag, point(content.split_ascii_whitespace(), line)?, line)?;
            }
        }
        Ok(())
    }

    fn elements_2(&mut self, lines: &mut Lines<'_>) -> Result<(), ReadFault> {
        let (line, words) = lines.next("a number of elements")?;
        for _ in 0..count(Some(words), line, "a number of elements")? {
            let (line, content) = lines.next("an element")?;
            let mut words = content.split_ascii_whitespace();
            integer(words.next(), line, "the number of an element")?;
            let kind = integer(words.next(), line, "the type of an element")?;
            let tags = count(words.next(), line, "a number of tags")?;
            let group = match tags {
                0 => 0,
                _ => integer(words.next(), line, "the number of a physical group")?,
            };
            let words = words.skip(tags.saturating_sub(1));
            self.add_element(kind, words, group, line)?;
        }
        Ok(())
    }

    fn elements_4(&mut self, lines: &mut Lines<'_>) -> Result<(), ReadFault> {
        for _ in 0..blocks(lines)? {
            let [_, volume, kind, elements] = block(lines)?;
            let group = self.groups.get(&volume).copied().unwrap_or(0);
            for _ in 0..elements {
                let (line, content) = lines.next("an element")?;
                let mut words = content.split_ascii_whitespace();
                integer(words.next(), line, "the number of an element")?;
                self.add_element(kind, words, group, line)?;
            }
        }
        Ok(())
    }

    fn add_node(&mut self, tag: i64, position: Vec3, line: usize) -> Result<(), ReadFault> {
        let place = self.volume.points.vertices.len() as u32;
        if self.places.insert(tag, place).is_some() {
            let expected = "the number of a node that was not there before";
            return Err(unexpected(line, &tag.to_string(), expected));
        }
        self.volume.points.add_vertex(position)
    }

    fn add_element<'a>(
        &mut self,
        kind: i64,
        mut words: impl Iterator<Item = &'a str>,
        region: i64,
        line: usize,
    ) -> Result<(), ReadFault> {
        let cell = self.cells;
        self.cells += 1;
        let rest = match kind {
            TETRAHEDRON => 0,
            QUADRATIC_TETRAHEDRON => 6,
            _ if FLAT.contains(&kind) => return Ok(()),
            _ => {
                let found = named(kind);
                return Err(ReadFault::NotATetrahedron { cell, found });
            }
        };
        let mut corners = [0; 4];
        for corner in &mut corners {
            let found = integer(words.next(), line, "the number of a node")?;
            let place = self.places.get(&found);
            *corner = *place.ok_or(ReadFault::BadCorner {
                cell,
                found,
                vertices: self.places.len(),
            })?;
        }
        for _ in 0..rest {
            integer(words.next(), line, "the number of a node")?;
        }
        if let Some(word) = words.next() {
            return Err(unexpected(line, word, "the end of the line"));
        }
        self.volume.tetrahedra.push(corners);
        self.volume.regions.push(region);
        Ok(())
    }
}

fn point<'a>(mut words: impl Iterator<Item = &'a str>, line: usize) -> Result<Vec3, ReadFault> {
    let mut coordinate = || number(words.next(), line);
    Ok(Vec3::new(coordinate()?, coordinate()?, coordinate()?))
}

/// The first line of a section of version 4: how many blocks follow.
fn blocks(lines: &mut Lines<'_>) -> Result<usize, ReadFault> {
    let (line, content) = lines.next("a number of blocks")?;
    let first = content.split_ascii_whitespace().next();
    count(first, line, "a number of blocks")
}

/// The first line of a block of version 4: dimension, number of the entity, then for nodes whether
/// they have parameters, for elements their type, then how many follow.
fn block(lines: &mut Lines<'_>) -> Result<[i64; 4], ReadFault> {
    let (line, content) = lines.next("a block")?;
    let mut words = content.split_ascii_whitespace();
    let mut next = || integer(words.next(), line, "a block of four numbers");
    Ok([next()?, next()?, next()?, next()?])
}

fn named(kind: i64) -> String {
    let name = match kind {
        5 | 12 | 17 | 92 | 93 => "a hexahedron",
        6 | 13 | 18 | 90 | 91 => "a prism",
        7 | 14 | 19 | 118 | 119 => "a pyramid",
        29..=31 => "a tetrahedron of high order",
        _ => "an unknown element",
    };
    format!("{name} (type {kind})")
}
