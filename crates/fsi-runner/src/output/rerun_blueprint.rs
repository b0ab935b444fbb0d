//! The viewer's layout: the scene beside tabs of plots, the camera set from
//! the scene's bounds.
//!
//! Written to a blueprint store by hand, because the typed builder of this SDK
//! version has no camera, background or grid.

use super::frame::RunHeader;
use super::plots::Plot;
use super::rerun_scene::{LEGEND, WORLD};
use super::view_camera::Camera;
use rerun::external::re_log_types::{BlueprintActivationCommand, LogMsg};
use rerun::external::re_sdk_types::blueprint::{archetypes as layout, components as part};
use rerun::external::re_sdk_types::datatypes::{Bool, Uuid};
use rerun::{RecordingStream, RecordingStreamBuilder, RecordingStreamError};

/// More plots than this share a grid of two columns.
const LONGEST_STACK: usize = 4;

/// Sends the layout and makes it the active one.
pub fn send(
    recording: &RecordingStream,
    header: &RunHeader,
    camera: Option<Camera>,
    gauges: &[Plot],
    ledger: &[Plot],
) -> Result<(), RecordingStreamError> {
    let Some(info) = recording.store_info() else {
        return Ok(());
    };
    let application = info.application_id().clone();
    let (store, memory) = RecordingStreamBuilder::new(application).blueprint().memory()?;
    store.set_time_sequence("blueprint", 0);
    let mut sheet = Sheet { store, last: 0 };
    let root = sheet.whole(header, camera, gauges, ledger)?;
    sheet.frame(root)?;
    drop(sheet);
    let messages = memory.take();
    let id = messages.iter().find_map(|message| match message {
        LogMsg::SetStoreInfo(info) => Some(info.info.store_id.clone()),
        _ => None,
    });
    if let Some(blueprint_id) = id {
        let command =
            BlueprintActivationCommand { blueprint_id, make_active: true, make_default: true };
        recording.send_blueprint(messages, command);
    }
    Ok(())
}

/// A part of the layout.
#[derive(Clone, Copy)]
struct Item {
    kind: &'static str,
    id: u8,
}

impl Item {
    fn path(self) -> String {
        format!("{}/00000000-0000-4000-8000-0000000000{:02x}", self.kind, self.id)
    }
}

struct Sheet {
    store: RecordingStream,
    last: u8,
}

impl Sheet {
    fn whole(
        &mut self,
        header: &RunHeader,
        camera: Option<Camera>,
        gauges: &[Plot],
        ledger: &[Plot],
    ) -> Result<Item, RecordingStreamError> {
        let scene = self.scene(header, camera)?;
        let legend = self.view("TextDocument", "Colours", LEGEND)?;
        let left = self.container(part::ContainerKind::Vertical, "Scene", &[scene, legend])?;
        self.shares(left, &[], &[9.0, 1.0])?;
        let mut tabs = Vec::new();
        for (name, plots) in [("Gauges", gauges), ("Ledger", ledger)] {
            if !plots.is_empty() {
                tabs.push(self.stack(name, plots)?);
            }
        }
        if tabs.is_empty() {
            return Ok(left);
        }
        let right = self.container(part::ContainerKind::Tabs, "Plots", &tabs)?;
        let root = self.container(part::ContainerKind::Horizontal, "Run", &[left, right])?;
        self.shares(root, &[2.0, 1.0], &[])?;
        Ok(root)
    }

    fn scene(
        &mut self,
        header: &RunHeader,
        camera: Option<Camera>,
    ) -> Result<Item, RecordingStreamError> {
        let view = self.view("3D", &header.case_name, WORLD)?;
        let path = view.path();
        if let Some(camera) = camera {
            let single = |v: [f64; 3]| v.map(|x| x as f32);
            let eye = layout::EyeControls3D::new()
                .with_kind(part::Eye3DKind::Orbital)
                .with_position(single(camera.position))
                .with_look_target(single(camera.target))
                .with_eye_up(single(camera.up));
            self.store.log(format!("{path}/EyeControls3D"), &eye)?;
        }
        let background = layout::Background::new(part::BackgroundKind::SolidColor)
            .with_color([24u8, 28, 36, 255]);
        self.store.log(format!("{path}/Background"), &background)?;
        let grid = layout::LineGrid3D::new().with_visible(false);
        self.store.log(format!("{path}/LineGrid3D"), &grid)?;
        Ok(view)
    }

    fn stack(&mut self, name: &str, plots: &[Plot]) -> Result<Item, RecordingStreamError> {
        let mut views = Vec::new();
        for plot in plots {
            let view = self.view("TimeSeries", &plot.title, &plot.path)?;
            let legend = layout::PlotLegend::new().with_corner(part::Corner2D::LeftTop);
            self.store.log(format!("{}/PlotLegend", view.path()), &legend)?;
            views.push(view);
        }
        if views.len() > LONGEST_STACK {
            let grid = self.container(part::ContainerKind::Grid, name, &views)?;
            let columns = layout::ContainerBlueprint::update_fields().with_grid_columns(2u32);
            self.store.log(grid.path(), &columns)?;
            return Ok(grid);
        }
        self.container(part::ContainerKind::Vertical, name, &views)
    }

    fn view(
        &mut self,
        class: &str,
        name: &str,
        origin: &str,
    ) -> Result<Item, RecordingStreamError> {
        let view = self.next("view");
        let path = view.path();
        let contents = layout::ViewContents::new([part::QueryExpression("$origin/**".into())]);
        self.store.log(format!("{path}/ViewContents"), &contents)?;
        let blueprint = layout::ViewBlueprint::new(part::ViewClass(class.into()))
            .with_display_name(name)
            .with_space_origin(format!("/{origin}"));
        self.store.log(path, &blueprint)?;
        Ok(view)
    }

    fn container(
        &mut self,
        kind: part::ContainerKind,
        name: &str,
        items: &[Item],
    ) -> Result<Item, RecordingStreamError> {
        let container = self.next("container");
        let contents = items.iter().map(|item| part::IncludedContent(item.path().into()));
        let blueprint =
            layout::ContainerBlueprint::new(kind).with_display_name(name).with_contents(contents);
        self.store.log(container.path(), &blueprint)?;
        Ok(container)
    }

    fn shares(
        &mut self,
        container: Item,
        columns: &[f32],
        rows: &[f32],
    ) -> Result<(), RecordingStreamError> {
        let mut shares = layout::ContainerBlueprint::update_fields();
        if !columns.is_empty() {
            shares = shares.with_col_shares(columns.iter().copied());
        }
        if !rows.is_empty() {
            shares = shares.with_row_shares(rows.iter().copied());
        }
        self.store.log(container.path(), &shares)
    }

    fn frame(&mut self, root: Item) -> Result<(), RecordingStreamError> {
        let mut bytes = [0, 0, 0, 0, 0, 0, 0x40, 0, 0x80, 0, 0, 0, 0, 0, 0, 0];
        bytes[15] = root.id;
        let viewport = layout::ViewportBlueprint::new()
            .with_root_container(part::RootContainer(Uuid { bytes }))
            .with_auto_layout(part::AutoLayout(Bool(false)))
            .with_auto_views(part::AutoViews(Bool(false)));
        self.store.log("viewport", &viewport)?;
        for panel in ["blueprint_panel", "selection_panel"] {
            let hidden = layout::PanelBlueprint::new().with_state(part::PanelState::Hidden);
            self.store.log(panel, &hidden)?;
        }
        let time = layout::TimePanelBlueprint::new()
            .with_state(part::PanelState::Collapsed)
            .with_timeline("sim_time");
        self.store.log("time_panel", &time)
    }

    fn next(&mut self, kind: &'static str) -> Item {
        self.last += 1;
        Item { kind, id: self.last }
    }
}
