// The part of Apache ECharts that the page uses.
import { LineChart, ParallelChart, ScatterChart } from 'echarts/charts';
import { DataZoomInsideComponent, GridComponent, LegendComponent, ParallelComponent, TooltipComponent } from 'echarts/components';
import { init, setPlatformAPI, use } from 'echarts/core';
import { CanvasRenderer } from 'echarts/renderers';

use([LineChart, ParallelChart, ScatterChart, DataZoomInsideComponent, GridComponent, LegendComponent,
	ParallelComponent, TooltipComponent, CanvasRenderer]);

// Ten thousand lines and points are faster drawn by the processor than by a graphics driver that gets
// them one by one, and much faster where the driver is a program itself.
setPlatformAPI({
	createCanvas() {
		const canvas = document.createElement('canvas');
		const { getContext } = canvas;
		canvas.getContext = (kind) => getContext.call(canvas, kind, { willReadFrequently: true });
		return canvas;
	},
});
export { init };
