//! The region of each tetrahedron of a solid.

use palpate_geometry::{AabbTree, Fidelity, Level, Surface, TetrahedronError, TetrahedronMesh};

use super::problem::{Body, SolidPlace, SolidProblem};
use crate::Error;
use crate::regions::{Bordered, RegionError, RegionMap, RegionPlace};

/// The regions of a problem.
#[derive(Debug)]
pub(super) struct SolidRegions {
    /// Those with borders.
    pub(super) map: RegionMap,
    /// Their names; the first has the number 1.
    names: Vec<String>,
    /// Number among the regions of the problem, from 1, of each region of the map from its number 1 on.
    bounded: Vec<usize>,
    /// The same for each number of a cell; empty where cells have none.
    cells: Vec<usize>,
}

impl SolidRegions {
    pub(super) fn new(problem: &SolidProblem) -> Result<Self, Error> {
        let mut places = Vec::new();
        let mut bounded = Vec::new();
        let mut cells = Vec::new();
        for (region, number) in problem.regions.iter().zip(1..) {
            match &region.place {
                SolidPlace::Bounded(place) => {
                    places.push(place.clone());
                    bounded.push(number);
                }
                SolidPlace::Cells(cell) => {
                    let cell = *cell as usize;
                    cells.resize(cells.len().max(cell + 1), 0);
                    cells[cell] = number;
                }
            }
        }
        let map = match places.is_empty() {
            true => RegionMap::default(),
            false => {
                let found = bounded_map(&problem.body, places);
                found.map_err(|error| renumbered(error, &bounded))?
            }
        };
        Ok(Self {
            map,
            names: problem
                .regions
                .iter()
                .map(|region| region.name.clone())
                .collect(),
            bounded,
            cells,
        })
    }

    /// The `mesh` of the body within `surface`, with vertices on `levels` and on the borders of all regions that have some.
    pub(super) fn bordered(
        &self,
        mesh: &TetrahedronMesh,
        surface: Option<&Surface>,
        levels: &[Level<'_>],
    ) -> Result<Bordered, TetrahedronError> {
        let bounded: Vec<_> = self.map.bounded().collect();
        self.map.bordered(mesh, surface, levels, &bounded)
    }

    /// The mesh with its regions, as numbers among those of the problem from 1; and warnings.
    pub(super) fn put(&self, found: Bordered) -> Result<(TetrahedronMesh, Vec<String>), Error> {
        let bounded: Vec<_> = self.map.bounded().collect();
        let regions = (0..found.mesh.tetrahedra().len()).map(|tetrahedron| {
            let number = match found.border_around(tetrahedron) {
                None => {
                    let cell = found.mesh.region(tetrahedron) as usize;
                    self.cells.get(cell).copied().unwrap_or(0)
                }
                Some(border) => self.bounded[bounded[border] - 1],
            };
            number as u32
        });
        let regions: Vec<_> = regions.collect();
        let is_somewhere = |number: &usize| regions.contains(&(*number as u32));
        if let Some(number) = (1..=self.names.len()).find(|number| !is_somewhere(number)) {
            let region = number - 1;
            return Err(RegionError::Nowhere { region }.into());
        }
        let has_layers = self.map.bounded().any(|number| self.map.is_layer(number));
        if has_layers && self.cells.is_empty() && !is_somewhere(&0) {
            let thickness = self.map.thickness_of_layers();
            return Err(RegionError::NothingBelowLayers { thickness }.into());
        }
        let crossing: usize = found.borders.iter().map(|level| level.crossing).sum();
        let mesh = found.mesh;
        let mut warnings = self.volumes_off(&mesh, &regions);
        if crossing > 0 {
            warnings.push(format!(
                "{crossing} edges of the mesh cross the borders of regions, which lie up to half an edge off there"
            ));
        }
        Ok((mesh.with_regions(regions)?, warnings))
    }

    /// Warnings where tetrahedra give a shape another volume than its border encloses.
    fn volumes_off(&self, mesh: &TetrahedronMesh, regions: &[u32]) -> Vec<String> {
        let mut volumes = vec![0.0; self.names.len() + 1];
        for (tetrahedron, &region) in regions.iter().enumerate() {
            volumes[region as usize] += mesh.volume_of(tetrahedron);
        }
        let places = self.bounded.iter().zip(1..);
        let off = places.filter_map(|(&region, number)| {
            let [expected, _] = self.map.volume_and_area(number)?;
            let off = volumes[region] / expected - 1.0;
            let less_or_more = if off < 0.0 { "less" } else { "more" };
            (off.abs() > Fidelity::VOLUME).then(|| {
                format!(
                    "the region `{}` has {:.1} % {less_or_more} volume in the mesh than its border encloses; the estimated \
                     error does not include what that changes",
                    self.names[region - 1],
                    100.0 * off.abs()
                )
            })
        });
        off.collect()
    }
}

/// The places in a body.
fn bounded_map(body: &Body, places: Vec<RegionPlace>) -> Result<RegionMap, RegionError> {
    let boundary;
    let surface = match body {
        Body::Surface(surface) => surface,
        Body::Volume(mesh) => {
            boundary = mesh.boundary_surface().map_err(RegionError::NoSurface)?;
            &boundary
        }
    };
    RegionMap::new(surface, &AabbTree::new(surface.mesh()), places)
}

/// The same with the numbers of the problem.
fn renumbered(error: RegionError, bounded: &[usize]) -> RegionError {
    let number = |region: usize| bounded[region] - 1;
    match error {
        RegionError::Outside { region, outside } => RegionError::Outside {
            region: number(region),
            outside,
        },
        RegionError::Overlap { regions } => RegionError::Overlap {
            regions: regions.map(number),
        },
        other => other,
    }
}
