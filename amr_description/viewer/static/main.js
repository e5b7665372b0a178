function B(s,t={},...e){let n=document.createElement(s);for(let[i,r]of Object.entries(t))typeof r=="function"?n.addEventListener(i.slice(2),r):r!==!1&&r!==null&&n.setAttribute(i,r===!0?"":String(r));return n.append(...e.filter(i=>i!==null)),n}var Ob={play:"M5 3.5v9l7.5-4.5z",pause:"M4.5 3.5h2.5v9H4.5zM9 3.5h2.5v9H9z",step:"M3.5 3.5v9L9.5 8zM10.5 3.5h2v9h-2z",reset:"M8 2.5V0L4 3.5 8 7V4.3a3.9 3.9 0 1 1-3.9 3.9H2.3A5.7 5.7 0 1 0 8 2.5z",theme:"M8 1.5a6.5 6.5 0 1 0 0 13zM8 1.5v1.3a5.2 5.2 0 0 1 0 10.4v1.3a6.5 6.5 0 0 0 0-13z",panels:"M2 3h12v2H2zM2 7h12v2H2zM2 11h12v2H2z",close:"M3 4.4 4.4 3 8 6.6 11.6 3 13 4.4 9.4 8l3.6 3.6-1.4 1.4L8 9.4 4.4 13 3 11.6 6.6 8z",down:"M3 5.5 8 10.5l5-5z",up:"M3 10.5 8 5.5l5 5z"};function mf(s){let t="http://www.w3.org/2000/svg",e=document.createElementNS(t,"svg");e.setAttribute("viewBox","0 0 16 16"),e.setAttribute("class","icon"),e.setAttribute("aria-hidden","true");let n=document.createElementNS(t,"path");return n.setAttribute("d",Ob[s]),e.append(n),e}function $e(s,t,{icon:e,title:n,kind:i}={}){return B("button",{type:"button",class:i===void 0?"button":`button ${i}`,title:n??null,"aria-label":s===""?n??null:null,onclick:t},e===void 0?null:mf(e),s===""?null:B("span",{},s))}var Fb=3e3;function _g(s,t,e){let n=null,i=()=>{n=null,r.classList.remove("danger"),r.replaceChildren(B("span",{},s))},r=$e(s,()=>{if(n!==null){clearTimeout(n),i(),e();return}r.classList.add("danger"),r.replaceChildren(B("span",{},t)),n=setTimeout(i,Fb)},{kind:"quiet"});return r}function ja(s,t,e,n=null){let i=B("button",{type:"button",class:"toggle",title:n},s);return i.setAttribute("aria-pressed",String(t)),i.addEventListener("click",()=>{let r=i.getAttribute("aria-pressed")!=="true";i.setAttribute("aria-pressed",String(r)),e(r)}),i}function Tn(s,...t){return B("section",{class:"section"},B("h3",{},s),...t)}function xg(s,t,e){let n=t.map(({name:i,number:r})=>B("th",{scope:"col",class:r===!0?"number":null},i));return B("div",{class:"table"},B("table",{},B("caption",{class:"unseen"},s),B("thead",{},B("tr",{},...n)),e))}function gf(s){let t=s.map(([e,n])=>B("div",{},B("dt",{},e),B("dd",{title:n},n)));return B("dl",{class:"facts"},...t)}function he(s,t){s.textContent!==t&&(s.textContent=t)}function yf(s,t){return s instanceof HTMLElement?s.matches("textarea, select, input:not([type=range], [type=checkbox])")?!0:t.startsWith("Arrow")&&s.closest("[type=range], [role=tablist], .chart-plot")!==null:!1}var Ub={info:5e3,warning:9e3,error:12e3},Bb=3;function vg(s){let t=B("div",{class:"unseen",role:"status","aria-live":"polite"}),e=B("div",{class:"toasts"}),n=s.notices[0],i=n?.count??0;return s.watch(["notice"],()=>{let[r]=s.notices;if(r!==void 0&&(r!==n||r.count!==i)){let o=r===n;for(n=r,i=r.count,o&&e.firstElementChild?.remove(),e.prepend(kb(r.level,r.text)),he(t,r.text);e.childElementCount>Bb;)e.lastElementChild?.remove()}}),s.watch(["link"],()=>{he(t,{connecting:"",open:"Connected.",waiting:"The connection was lost."}[s.link.state])}),s.watch(["driver","robot"],()=>{let{driver:r}=s;he(t,r===null?"":r.me?"You drive.":`${r.name} drives.`)}),B("div",{class:"announce"},t,e)}function kb(s,t){let e=B("div",{class:"toast","data-tone":s},B("p",{},t)),n=()=>e.remove();return e.append($e("",n,{icon:"close",kind:"quiet",title:"Dismiss"})),setTimeout(n,Ub[s]),e}var bg="amr.v1";var zb=250,Vb=4e3,Gb=1.7,Sg=20,Hb={open:(s,t)=>new WebSocket(s,t),after:(s,t)=>{let e=setTimeout(t,s);return()=>clearTimeout(e)}},Wb=1,bc=class{constructor(t,e=Hb){this.url=t;this.port=e}url;port;link={state:"connecting"};onLink=()=>{};onMessage=()=>{};onBinary=()=>{};socket=null;attempt=0;nextId=1;waiting=new Map;cancelRetry=null;open(){this.cancelRetry?.(),this.cancelRetry=null,this.tell({state:"connecting"});let t=this.port.open(this.url,bg);t.binaryType="arraybuffer",t.onopen=()=>{this.attempt=0,this.tell({state:"open"})},t.onmessage=e=>this.receive(e.data),t.onclose=e=>this.closed(e.reason),this.socket=t}send(t){return this.socket===null||this.socket.readyState!==Wb?!1:(this.socket.send(JSON.stringify(t)),!0)}request(t){let e=this.nextId;return this.nextId+=1,new Promise(n=>{let i=this.port.after(Sg*1e3,()=>{this.answer(_f(e,`No answer to "${t.type}" within ${Sg} s.`))});this.waiting.set(e,r=>{i(),n(r)}),this.send({...t,id:e})||this.answer(_f(e,"There is no connection to the node."))})}receive(t){if(t instanceof ArrayBuffer)this.onBinary(t);else if(typeof t=="string"){let e=JSON.parse(t);(e.type!=="reply"||!this.answer(e))&&this.onMessage(e)}}answer(t){let e=this.waiting.get(t.id);return this.waiting.delete(t.id),e?.(t),e!==void 0}closed(t){this.socket=null;for(let n of[...this.waiting.keys()])this.answer(_f(n,"The connection to the node was lost."));let e=Math.min(zb*Gb**this.attempt,Vb);this.attempt+=1,this.cancelRetry=this.port.after(e,()=>this.open()),this.tell({state:"waiting",attempt:this.attempt,reason:t})}tell(t){this.link=t,this.onLink(t)}};function _f(s,t){return{type:"reply",id:s,ok:!1,message:t}}function Mg(s){return`${s.protocol==="https:"?"wss":"ws"}://${s.host}/ws${s.search}`}var Tg={forward:0,turn:0},Ag=new Map([["KeyW",{forward:1,turn:0}],["ArrowUp",{forward:1,turn:0}],["KeyS",{forward:-1,turn:0}],["ArrowDown",{forward:-1,turn:0}],["KeyA",{forward:0,turn:1}],["ArrowLeft",{forward:0,turn:1}],["KeyD",{forward:0,turn:-1}],["ArrowRight",{forward:0,turn:-1}]]),Eg=new Map([["KeyQ",{forward:0,turn:0,left:1}],["KeyE",{forward:0,turn:0,left:-1}]]);function Cg(s,t){return Ag.has(s)||t&&Eg.has(s)}function Rg(s){return $a([...s].map(t=>Ag.get(t)??Eg.get(t)??Tg))}function Ya(s,t,e){let n=Math.hypot(s,t);if(!Number.isFinite(n)||n<=e)return Tg;let i=(Math.min(n,1)-e)/(1-e)/n;return{forward:wg(-t*i),turn:wg(-s*i)}}function $a(s){let t=0,e=0,n=0;for(let r of s)t+=r.forward,e+=r.turn,n+=r.left??0;let i={forward:xf(t),turn:xf(e)};return n===0?i:{...i,left:xf(n)}}function Pg(s,t){let{forward:e,turn:n,left:i=0}=s,r={linear:e*t.linear,angular:n*t.angular};return i===0?r:{...r,sideways:i*t.linear}}function xf(s){return Math.min(1,Math.max(-1,s))}function wg(s){return s===0?0:s}var Lg=.12,Ig="gamepad",Xb=1;function qb({axes:s},t){let{forward:e,turn:n}=Ya(s[0]??0,s[1]??0,Lg),{turn:i}=Ya(s[2]??0,0,Lg),o=$a([t?{forward:e,turn:0,left:n}:{forward:e,turn:n},{forward:0,turn:i}]);return Object.values(o).every(a=>a===0)?null:o}function jb({buttons:s}){return s[Xb]?.pressed===!0}function Ng(s,t){let e=!1,n=!1,i=()=>{let r=navigator.getGamepads().find(a=>a!==null&&a.connected)??null;if(r===null){e=!1,s.set(Ig,null),t(null);return}let o=jb(r);o&&!n&&s.stop(),n=o,s.set(Ig,document.hasFocus()?qb(r,s.goesSideways):null),requestAnimationFrame(i)};window.addEventListener("gamepadconnected",r=>{t(r.gamepad.id.replace(/\s*\(.*$/,"")),e||(e=!0,requestAnimationFrame(i))})}var Yb=new Set(["MetaLeft","MetaRight","ControlLeft","ControlRight","AltLeft"]);function Dg(s){let t=new Set,e=()=>s.set("keys",t.size===0?null:Rg(t));window.addEventListener("keydown",i=>{i.code==="Escape"||i.code==="Space"&&Jb(i,s)?(i.preventDefault(),s.stop()):Yb.has(i.code)?(t.clear(),e()):Cg(i.code,s.goesSideways)&&$b(i)&&(i.preventDefault(),i.repeat||(t.add(i.code),e()))}),window.addEventListener("keyup",i=>{t.delete(i.code)&&e()});let n=()=>{s.release(),t.clear(),e()};window.addEventListener("blur",n),window.addEventListener("pagehide",n),document.addEventListener("visibilitychange",()=>{document.hidden&&n()})}function $b(s){return!(s.ctrlKey||s.metaKey||s.altKey)&&!yf(s.target,s.code)}function Jb(s,t){let{target:e}=s,i=e instanceof HTMLElement&&e.matches("button:focus-visible, a:focus-visible, summary:focus-visible");return t.driving||!(i||yf(e,s.code))}function we(s,t){if(s==null||!Number.isFinite(s))return"\u2013";let e=Math.abs(s).toFixed(t);return s<0&&Number(e)!==0?`\u2212${e}`:e}function Sc(s){return Number.isFinite(s)?`${we(s*180/Math.PI,1)}\xB0`:"\u2013"}function Mc(s){return s===null?"\u2013":`${we(s,2)}\xD7`}function Vr(s){if(!Number.isFinite(s))return"\u2013";if(s>1e8)return new Date(s*1e3).toLocaleTimeString("en-GB");let t=Math.floor(s*10+1e-6),e=Math.floor(t/10),n=Math.floor(e/3600),i=Math.floor(e/60)%60,r=`${String(e%60).padStart(2,"0")}.${t%10}`;return`${n===0?`${i}`:`${n}:${String(i).padStart(2,"0")}`}:${r}`}var ks=["command","odometry","truth"],Kb=7,Zb=8,Qb=9;function gr(s,t){return s.robots.find(e=>e.id===t)??null}function wc(s,t){return t==="command"?{linear:s.command[0],angular:s.command[1],sideways:s.command[2]}:{linear:s[t][Kb],angular:s[t][Zb],sideways:s[t][Qb]}}function Og(s,t){return s.layout.robots.find(({id:e})=>e===t.id)??{joints:[],wheels:[]}}function Tc(s,t){return Og(s,t).joints.map((e,n)=>({name:e,position:t.positions[n],velocity:t.velocities[n],commanded:t.commanded[n]}))}function Ac(s,t){let{joints:e,wheels:n}=Og(s,t);return n.map((i,r)=>{let[o,a,l,c]=t.wheels.subarray(r*4),h=t.velocities[e.indexOf(i)]??Number.NaN;return{name:i,speed:h,contact:tS(o),force:a,along:l,across:c}})}function tS(s){return Number.isNaN(s)?null:s>.5}var Fg="amr.",vf=new Map;function ui(s,t){vf.set(s,t);try{localStorage.setItem(Fg+s,t)}catch{}}function Ri(s){try{return vf.get(s)??localStorage.getItem(Fg+s)}catch{return vf.get(s)??null}}function Ec(s,t,e,n){let i=Number.parseFloat(Ri(s)??"");return i>=t&&i<=e?i:n}var eS=.08,Ug="joystick",Cc=class{constructor(t){this.pilot=t;this.element=B("div",{class:"joystick",role:"img","aria-label":"Joystick: drag to drive. With the keyboard: W A S D or the arrow keys."},B("div",{class:"joystick-cross"}),this.knob),this.element.addEventListener("pointerdown",e=>this.take(e)),this.element.addEventListener("pointermove",e=>this.move(e));for(let e of["pointerup","pointercancel","lostpointercapture"])this.element.addEventListener(e,n=>this.letGo(n));this.element.addEventListener("contextmenu",e=>e.preventDefault())}pilot;element;knob=B("div",{class:"joystick-knob"});pointer=null;show(t){let e=(this.element.clientWidth-this.knob.offsetWidth)/2,n=Math.max(1,Math.hypot(t.forward,t.turn)),i=-t.turn/n*e,r=-t.forward/n*e;this.knob.style.transform=`translate(${i.toFixed(1)}px, ${r.toFixed(1)}px)`;let o=t.forward!==0||t.turn!==0;this.element.classList.toggle("held",o||this.pointer!==null)}take(t){this.pointer===null&&t.button===0&&(t.preventDefault(),this.pointer=t.pointerId,this.element.setPointerCapture(t.pointerId),this.move(t))}move(t){if(t.pointerId!==this.pointer)return;let e=this.element.getBoundingClientRect(),n=(e.width-this.knob.offsetWidth)/2,i=(t.clientX-e.left-e.width/2)/n,r=(t.clientY-e.top-e.height/2)/n;this.pilot.set(Ug,Ya(i,r,eS))}letGo(t){t.pointerId===this.pointer&&(this.pointer=null,this.pilot.set(Ug,null))}};var nS={command:"Command",odometry:"Odometry",truth:"Truth"},Vg={linear:{label:"Speed",unit:"m/s",least:.05,most:2,step:.05,usual:.5},angular:{label:"Turn",unit:"rad/s",least:.1,most:4,step:.1,usual:1}},Rc=class{constructor(t){this.app=t;this.joystick=new Cc(t.pilot),t.pilot.limits={linear:Bg("linear"),angular:Bg("angular")},this.sideways=B("div",{class:"sideways",hidden:!0},zg(t.pilot,"Left","Q",1),zg(t.pilot,"Right","E",-1)),this.element=B("section",{class:"drive","aria-label":"Drive"},B("header",{class:"drive-head"},B("h2",{},"Drive"),this.who),this.joystick.element,this.readout(),this.sideways,B("div",{class:"drive-limits"},this.limit("linear"),this.limit("angular")),iS(t.pilot),B("div",{class:"drive-notes"},sS(),this.pad,this.topic)),t.store.watch(["graph","robot","driver","link","hello"],()=>this.showWho()),t.store.watch(["graph","robot","controllers"],()=>this.showTopic()),t.store.watch(["graph","robot","controllers"],()=>{t.pilot.goesSideways=t.store.goesSideways,this.sideways.hidden=!t.store.goesSideways,this.element.classList.toggle("goes-sideways",t.store.goesSideways)}),t.pilot.onChange=e=>this.showAsked(e)}app;id="drive";title="Drive";element;joystick;who=B("span",{class:"chip"});topic=B("p",{class:"fine"});pad=B("span",{class:"fine"});sideways;cells=new Map;pulse(t){let e=gr(t,this.app.store.robot?.id);for(let n of ks){let i=this.cells.get(n),r=e===null?null:wc(e,n);i!==void 0&&(he(i.linear,we(r?.linear,2)),he(i.angular,we(r?.angular,2)),he(i.sideways,we(r?.sideways,2)))}}showPad(t){he(this.pad,t===null?"":`Gamepad: ${t}`)}showAsked(t){let{linear:e,angular:n}=this.app.pilot.limits;this.joystick.show({forward:(t?.linear??0)/e,turn:(t?.angular??0)/n}),this.element.classList.toggle("driving",t!==null),document.documentElement.classList.toggle("driven",t!==null||this.drove())}drove(){return document.documentElement.classList.contains("driven")}showWho(){let{store:t}=this.app,e=t.robot?.command??null,n=t.driver,i=n===null?"Nobody drives":n.me?"You drive":`${n.name} drives`;he(this.who,i),this.who.dataset.tone=n===null?"calm":n.me?"good":"warning",this.element.classList.toggle("cannot",e===null||t.link.state!=="open"),this.app.pilot.setRobot(e===null?null:t.robot?.id??null)}showTopic(){let{robot:t,deafController:e}=this.app.store,n=t?.command??null;if(t===null)he(this.topic,"There is no robot.");else if(n===null){let r=this.app.store.movedJoints.size>0?" Its joints are moved under Joints.":"";he(this.topic,`Nothing hears velocity commands: this robot cannot be driven.${r}`)}else e!==null?he(this.topic,`${e.name} is ${e.state}: it hears no command.`):he(this.topic,n.topic);this.topic.classList.toggle("topic",n!==null&&e===null),this.topic.classList.toggle("deaf",e!==null),this.topic.title=n===null?"":`${n.message} on ${n.topic}`}readout(){let t=ks.map(n=>{let i={linear:B("td",{},"\u2013"),angular:B("td",{},"\u2013"),sideways:B("td",{class:"of-sideways"},"\u2013")};this.cells.set(n,i);let r=B("th",{scope:"row"},B("i",{class:`swatch ${n}`}),nS[n]);return B("tr",{},r,i.linear,i.sideways,i.angular)}),e=B("th",{scope:"col",class:"of-sideways",title:"m/s to the left"},"left");return B("table",{class:"readout"},B("caption",{class:"unseen"},"Velocity of the robot"),B("thead",{},B("tr",{},B("td"),kg("m/s"),e,kg("rad/s"))),B("tbody",{},...t))}limit(t){let{label:e,unit:n,least:i,most:r,step:o}=Vg[t],a=B("output",{}),l=B("input",{type:"range",min:i,max:r,step:o,value:this.app.pilot.limits[t]}),c=()=>{he(a,`${we(l.valueAsNumber,2)} ${n}`),l.setAttribute("aria-valuetext",`${we(l.valueAsNumber,2)} ${n}`)};return l.addEventListener("input",()=>{ui(`limit.${t}`,l.value),this.app.pilot.setLimits({...this.app.pilot.limits,[t]:l.valueAsNumber}),c()}),c(),B("label",{class:"slider"},B("span",{},e),l,a)}};function Bg(s){let{least:t,most:e,usual:n}=Vg[s];return Ec(`limit.${s}`,t,e,n)}function kg(s){return B("th",{scope:"col"},s)}function iS(s){let t=B("button",{type:"button",class:"stop","aria-label":"Stop all robots","aria-keyshortcuts":"Escape"},B("strong",{},"STOP"),B("span",{class:"keys"},B("kbd",{},"Space"),B("kbd",{},"Esc")));return t.addEventListener("pointerdown",()=>s.stop()),t.addEventListener("click",()=>s.stop()),t}function zg(s,t,e,n){let i=`sideways ${t}`,r=B("button",{type:"button",class:"button","aria-label":`${t}, sideways while held`,"aria-keyshortcuts":e},B("span",{},t),B("kbd",{},e));r.addEventListener("pointerdown",o=>{r.setPointerCapture(o.pointerId),s.set(i,{forward:0,turn:0,left:n})});for(let o of["pointerup","pointercancel","lostpointercapture"])r.addEventListener(o,()=>s.set(i,null));return r.addEventListener("contextmenu",o=>o.preventDefault()),r}function sS(){let s=["W","A","S","D"].map(t=>B("kbd",{},t));return B("p",{class:"fine keys-hint"},"Hold ",...s," or the arrow keys")}var rS=1e3/60,Gg=1e3/30,Pc=class{constructor(t){this.port=t}port;limits={linear:.5,angular:1};goesSideways=!1;onChange=()=>{};onRefused=()=>{};robot=null;hands=new Map;blocked=new Set;sentAt=-1/0;taken=!1;cancel=null;get driving(){return this.robot!==null&&this.hands.size>0}get velocity(){return this.driving?Pg($a([...this.hands.values()]),this.limits):null}setRobot(t){t!==this.robot&&(this.release(),this.robot=t)}setLimits(t){this.limits=t,this.driving&&this.changed()}set(t,e){if(e===null)this.blocked.delete(t),this.hands.delete(t)&&this.changed();else{if(this.blocked.has(t))return;this.taken?(this.blocked.add(t),this.onRefused()):oS(this.hands.get(t),e)||(this.hands.set(t,e),this.changed())}}release(){let t=this.driving;this.letGo(),t&&(this.sendStop(this.robot),this.onChange(null))}stop(){this.letGo(),this.sendStop(null),this.onChange(null)}halt(){let t=this.driving;this.letGo(),t&&this.onChange(null)}setTaken(t){this.taken=t,t&&this.halt()}keepUp(){this.driving&&this.port.now()-this.sentAt>=Gg&&this.sendDrive()}letGo(){for(let t of this.hands.keys())this.blocked.add(t);this.hands.clear(),this.cancel?.(),this.cancel=null}changed(){if(this.robot===null)return;if(this.hands.size===0){this.letGo(),this.sendStop(this.robot),this.onChange(null);return}this.onChange(this.velocity);let t=this.sentAt+rS-this.port.now();t<=0?this.sendDrive():this.schedule(t)}sendDrive(){let t=this.velocity;this.robot===null||t===null||(this.sentAt=this.port.now(),this.port.send({type:"drive",robot:this.robot,...t})?this.schedule(Gg):this.halt())}sendStop(t){this.port.send({type:"stop",robot:t})}schedule(t){this.cancel?.(),this.cancel=this.port.after(t,()=>{this.cancel=null,this.sendDrive()})}};function oS(s,t){return s!==void 0&&s.forward===t.forward&&s.turn===t.turn&&s.left===t.left}var aS=new Set(["spawn","delete"]);async function Hr(s,t){let{ok:e,message:n}=await s.connection.request(t);return(!e||aS.has(t.type))&&s.store.note(e?"info":"error",n),e}var lS={connecting:"Connecting \u2026",open:"Connected",waiting:"Reconnecting \u2026"},cS={connecting:"warning",open:"good",waiting:"error"},Lc=class{constructor(t,e){this.app=t;this.play=$e("",()=>this.playOrPause(),{title:"Pause"}),this.play.classList.add("play");let n=$e("",()=>this.simulate("step"),{icon:"step",title:"One step"});n.classList.add("step");let i=$e("",()=>this.simulate("reset_simulation"),{icon:"reset",title:"Reset: robots to their starts, time to 0"});this.transport=B("div",{class:"transport",role:"group","aria-label":"Simulation"},this.play,n,i),this.robots.addEventListener("change",()=>t.store.choose(this.robots.value));let r=$e("",e.flipTheme,{icon:"theme",title:"Light or dark"}),o=$e("Panels",e.openPanels,{icon:"panels"});o.classList.add("open-panels"),this.element=B("header",{class:"top"},B("img",{class:"mark",src:"icon.svg",alt:""}),B("h1",{},this.name,this.robots),this.link,this.domain,B("span",{class:"grow"}),this.transport,B("div",{class:"clock"},this.time,this.real),B("span",{class:"grow"}),r,o);let{store:a}=t;a.watch(["graph","robot"],()=>this.showRobots()),a.watch(["link","hello"],()=>this.showLink()),a.watch(["simulation","graph"],()=>this.showSimulation())}app;element;link=B("span",{class:"chip link"});robots=B("select",{"aria-label":"Robot"});name=B("span",{class:"robot-name"});transport;play;time=B("span",{class:"time",title:"Time"},"\u2013");real=B("span",{class:"factor",title:"Real-time factor"},"\u2013");domain=B("span",{class:"fine domain"});pulse(t){he(this.time,Vr(t.time))}showRobots(){let{graph:t,robot:e}=this.app.store,n=t?.robots??[];this.robots.hidden=n.length<2,this.name.hidden=n.length>=2,he(this.name,e?.name??"No robot"),this.robots.replaceChildren(...n.map(({id:i,name:r})=>B("option",{value:i},i==="/"?r:`${r} (${i.slice(1)})`))),this.robots.value=e?.id??"",document.title=e===null?"amr viewer":`${e.name} \xB7 amr viewer`}showLink(){let{link:t,hello:e}=this.app.store;he(this.link,lS[t.state]),this.link.dataset.tone=cS[t.state],he(this.domain,e===null?"":`${e.client} \xB7 domain ${e.domain}`),this.domain.title=e===null?"":`amr_description ${e.version}`}showSimulation(){let{simulator:t,simulation:e}=this.app.store;this.transport.hidden=t===null,this.real.hidden=t===null;let n=e!==null&&e.state!=="playing",i=n?"Play":"Pause";(this.play.title!==i||this.play.childElementCount===0)&&(this.play.replaceChildren(mf(n?"play":"pause")),this.play.title=i,this.play.setAttribute("aria-label",i)),this.play.classList.toggle("primary",n),he(this.real,n?e.state:Mc(e?.real_factor??null))}playOrPause(){let t=this.app.store.simulation?.state==="playing";this.simulate(t?"pause":"play")}simulate(t){let e=this.app.store.simulator?.id;e!==void 0&&Hr(this.app,t==="step"?{type:t,simulator:e,steps:1}:{type:t,simulator:e})}};function Hg({app:s,stream:t,recorder:e,view:n,sensors:i}){let{store:r,pilot:o}=s;window.amr={get now(){return{link:r.link.state,client:r.client,robot:r.robot?.id??null,driver:r.driver?.name??null,driving:o.driving,...t.counts,time:t.latest?.time??null,age:t.latest===null?null:performance.now()-t.arrivedAt,samples:e.length,pictures:i.drawn,notices:r.notices.length,scene:hS(n.scene)}}}}function hS(s){return s===null?null:{...s.stats(),extent:s.extent(),trails:s.trailSizes(),sensors:s.sensorNumbers()}}var Ic=class{constructor(t){this.app=t;t.store.watch(["controllers","graph","robot"],()=>this.show())}app;id="control";title="Control";element=B("div",{});signature="";show(){let{robot:t,controllers:e}=this.app.store,n=t===null?void 0:e.get(t.id),i=JSON.stringify([t?.id,n??null]);if(i===this.signature)return;if(this.signature=i,n===void 0){this.element.replaceChildren(B("p",{class:"empty"},"No controller manager runs for this robot."));return}let r=document.activeElement?.id;this.element.replaceChildren(Tn("Controllers",Wg(n.controllers.map(o=>this.controller(o)))),Tn("Hardware",Wg(n.hardware.map(uS)))),r!==void 0&&r.startsWith("switch-")&&document.getElementById(r)?.focus()}controller({name:t,kind:e,state:n,claims:i}){let r=n==="active",o=B("button",{type:"button",role:"switch",class:"switch",id:`switch-${t}`,"aria-checked":String(r),"aria-label":`${t} is active`,title:r?`Deactivate ${t}`:`Activate ${t}`,disabled:!r&&n!=="inactive"});o.addEventListener("click",()=>{this.flip(t,!r,o)});let a=i.length===0?"claims nothing":`claims ${i.join(", ")}`;return B("li",{class:"unit"},B("span",{class:"unit-name"},t),Xg(n),o,B("span",{class:"fine"},e),B("span",{class:"fine"},a))}async flip(t,e,n){let i=this.app.store.robot;i!==null&&(n.disabled=!0,n.setAttribute("aria-busy","true"),await Hr(this.app,{type:"switch",robot:i.id,activate:e?[t]:[],deactivate:e?[]:[t]}),n.disabled=!1,n.removeAttribute("aria-busy"))}};function uS({name:s,kind:t,state:e}){return B("li",{class:"unit"},B("span",{class:"unit-name"},s),Xg(e),B("span",{class:"fine"},t))}function Xg(s){return B("span",{class:"chip","data-tone":s==="active"?"good":s==="inactive"?"calm":"warning"},s)}function Wg(s){return s.length===0?B("p",{class:"empty"},"None."):B("ul",{class:"rows"},...s)}var dS={position:[0,0,0],orientation:[0,0,0,1]};function fS(s,t){let[e,n,i,r,o,a,l]=s.poses.subarray(t*7);return{position:[e,n,i],orientation:[r,o,a,l]}}function jg(s,t,e){let n=qg(s,t),i=qg(s,e);return n.root===i.root?$g(pS(i.pose),n.pose):null}function Yg([s,t,e,n]){let i=Math.max(-1,Math.min(1,2*(n*t-e*s)));return[Math.atan2(2*(n*s+t*e),1-2*(s*s+t*t)),Math.asin(i),Math.atan2(2*(n*e+s*t),1-2*(t*t+e*e))]}function Sf(s){let t=new Set(s.frames.map(({name:e})=>e));return[...new Set(s.frames.map(({parent:e})=>e))].filter(e=>!t.has(e))}function qg(s,t){let{frames:e}=s.layout,n=t,i=dS;for(let r=e.length-1;r>=0;r-=1)e[r].name===n&&(i=$g(fS(s,r),i),n=e[r].parent);return{root:n,pose:i}}function $g(s,t){let[e,n,i]=Jg(s.orientation,t.position),[r,o,a]=s.position;return{position:[r+e,o+n,a+i],orientation:bf(s.orientation,t.orientation)}}function pS({position:s,orientation:t}){let[e,n,i,r]=t,o=[-e,-n,-i,r],[a,l,c]=Jg(o,s);return{position:[-a,-l,-c],orientation:o}}function bf(s,t){return[s[3]*t[0]+s[0]*t[3]+s[1]*t[2]-s[2]*t[1],s[3]*t[1]-s[0]*t[2]+s[1]*t[3]+s[2]*t[0],s[3]*t[2]+s[0]*t[1]-s[1]*t[0]+s[2]*t[3],s[3]*t[3]-s[0]*t[0]-s[1]*t[1]-s[2]*t[2]]}function Jg(s,[t,e,n]){let i=[-s[0],-s[1],-s[2],s[3]],[r,o,a]=bf(bf(s,[t,e,n,0]),i);return[r,o,a]}var Nc=class{constructor(t,e){this.app=t;this.choices=e;let{store:n}=t;this.fixed.addEventListener("change",()=>n.setFixedFrame(this.fixed.value||null)),this.element.append(B("label",{class:"field"},B("span",{},"Fixed frame"),this.fixed),Tn("Tree",this.tree),Tn("Chosen frame",this.where)),n.watch(["layout"],()=>this.build()),n.watch(["frame"],()=>{this.fixed.value=n.fixedFrame??""}),n.watch(["selection","frame"],()=>this.showSelection())}app;choices;id="frames";title="Frames";element=B("div",{});tree=B("ul",{class:"tree","aria-label":"TF tree"});fixed=B("select",{id:"fixed-frame"});where=B("div",{});rows=new Map;values=new Map;signature="";pulse(t){let e=this.app.store.selection?.frame??null;if(e===null)return;let n=this.app.store.fixedFrame??Sf(t.layout)[0],i=t.layout.frames.find(({name:r})=>r===e)?.parent;for(let[r,o]of[["parent",i],["fixed",n]]){let a=o===void 0?null:jg(t,e,o),[l,c,h]=a?.position??[],[u,d,f]=a===null?[]:Yg(a.orientation),m=a===null?[]:a.orientation;this.put(`${r} in`,o??"\u2013"),this.put(`${r} xyz`,[l,c,h].map(y=>we(y,3)).join("  ")),this.put(`${r} rpy`,[u,d,f].map(y=>Sc(y??Number.NaN)).join("  ")),this.put(`${r} q`,m.map(y=>we(y,3)).join("  "))}}put(t,e){let n=this.values.get(t);n!==void 0&&he(n,e)}build(){let t=this.app.store.layout,e=JSON.stringify(t?.frames??[]);if(e===this.signature)return;this.signature=e,this.rows.clear();let n=t===null?[]:Sf(t);this.fixed.replaceChildren(B("option",{value:""},"automatic"),...this.choices().map(i=>B("option",{value:i},i))),this.fixed.value=this.app.store.fixedFrame??"",this.tree.replaceChildren(...t===null?[]:n.map(i=>this.branch(i,t))),n.length===0&&this.tree.replaceChildren(B("li",{class:"empty"},"Nobody publishes transforms.")),this.showSelection()}branch(t,e){let n=e.frames.filter(({parent:r})=>r===t).map(({name:r})=>this.branch(r,e)),i=B("button",{type:"button",class:"frame"},t);return i.addEventListener("click",()=>{let r=this.app.store.robot?.id??"/";this.app.store.select({robot:r,frame:t})}),this.rows.set(t,i),B("li",{},i,n.length===0?null:B("ul",{},...n))}showSelection(){let t=this.app.store.selection?.frame??null;for(let[e,n]of this.rows)n.setAttribute("aria-pressed",String(e===t));if(this.values.clear(),t===null){this.where.replaceChildren(B("p",{class:"fine"},"Choose a frame here, or click a part of the robot."));return}this.where.replaceChildren(B("p",{class:"chosen"},t),this.poseTable("parent","Relative to"),this.poseTable("fixed","Relative to"))}poseTable(t,e){let n=(i,r)=>{let o=B("dd",{},"\u2013");return this.values.set(`${t} ${r}`,o),B("div",{},B("dt",{},i),o)};return B("dl",{class:"facts numbers"},n(e,"in"),n("x y z, m","xyz"),n("roll pitch yaw","rpy"),n("quaternion x y z w","q"))}};var Kg=["error","stale","warn","ok"],mS={error:"error",stale:"warning",warn:"warning",ok:"good"},Zg=["Wheel","rad/s","Load, N","Slip along","across"],Dc=class{constructor(t){this.app=t;let e=Zg.map((n,i)=>({name:n,number:i>0}));this.wheelSection=Tn("Wheels on the ground",xg("Contact and slip of each wheel",e,this.wheels),B("p",{class:"fine"},"Slip in m/s: along the rolling direction and across it.")),this.element=B("div",{},Tn("Diagnostics",this.diagnostics),this.wheelSection,Tn("Notices",this.notices,$e("Clear",()=>t.store.clearNotices()))),t.store.watch(["diagnostics","graph","robot"],()=>this.showDiagnostics()),t.store.watch(["notice"],()=>this.showNotices())}app;id="health";title="Health";element;watches=["wheels"];diagnostics=B("ul",{class:"rows"});wheels=B("tbody",{});notices=B("ul",{class:"rows notices"});wheelSection;names="";get toLookAt(){return this.items().filter(({level:t})=>t!=="ok").length}pulse(t){let e=gr(t,this.app.store.robot?.id),n=e===null?[]:Ac(t,e),i=n.map(({name:r})=>r).join();this.wheelSection.hidden=n.length===0,i!==this.names&&(this.names=i,this.wheels.replaceChildren(...n.map(gS))),n.forEach((r,o)=>yS(this.wheels.rows[o],r))}items(){let{robot:t,diagnostics:e}=this.app.store;return t===null?[]:e.get(t.id)?.items??[]}showDiagnostics(){let t=[...this.items()].sort((e,n)=>Kg.indexOf(e.level)-Kg.indexOf(n.level));this.diagnostics.replaceChildren(...t.map(({level:e,name:n,message:i})=>B("li",{class:"unit"},B("span",{class:"unit-name"},n),B("span",{class:"chip","data-tone":mS[e]},e),B("span",{class:"fine"},i)))),t.length===0&&this.diagnostics.append(B("li",{class:"empty"},"Nobody publishes /diagnostics."))}showNotices(){let{notices:t}=this.app.store;this.notices.replaceChildren(...t.map(({level:e,text:n,count:i,at:r})=>B("li",{"data-tone":e},B("time",{class:"fine"},r.toLocaleTimeString("en-GB")),B("span",{class:"grow"},i>1?`${n} (${i} times)`:n)))),t.length===0&&this.notices.append(B("li",{class:"empty"},"None."))}};function gS({name:s}){let t=Zg.slice(1).map(()=>B("td",{class:"number"})),e=s.replace(/^joint_/,"").replace(/_joint$/,"").replace(/^wheel_/,"");return B("tr",{},B("th",{scope:"row",title:s},B("i",{}),e),...t)}function yS(s,t){let{speed:e,contact:n,force:i,along:r,across:o}=t,a=s.cells[0].firstElementChild,l=n===null?"unknown":n?"on the ground":"in the air";a?.setAttribute("class",`lamp ${n===!0?"on":""}`),a?.setAttribute("title",l),[we(e,2),we(i,1),we(r,3),we(o,3)].forEach((h,u)=>he(s.cells[u+1],h))}var _S=1500,xS=50,Oc=class{constructor(t){this.app=t;t.store.watch(["model","graph","robot","controllers"],()=>this.build())}app;id="joints";title="Joints";element=B("div",{});rows=new Map;wanted={};signature="";isSending=!1;sentAt=0;pulse(t){let e=gr(t,this.app.store.robot?.id);for(let n of e===null?[]:Tc(t,e))this.rows.get(n.name)?.show(n)}build(){let{model:t,robot:e,movedJoints:n}=this.app.store,i=e?.joint_publisher??null,r=t?.joints??[],{joint_states:o}=e??{},a=JSON.stringify([e?.id,i,o,r,[...n]]);if(a===this.signature)return;if(this.signature=a,this.rows.clear(),r.length===0){this.element.replaceChildren(B("p",{class:"empty"},"No joint moves."));return}let l=r.filter(h=>h.follows===null),c=({name:h,follows:u})=>i===null?n.has(h):u===null;this.element.replaceChildren(i===null?this.watching():this.tools(l),...r.map(h=>this.row(h,c(h))))}watching(){let{robot:t,movedJoints:e}=this.app.store,n=t?.joint_states??null,i=n===null?"Nobody publishes joint states.":`Measured, from ${n}.`,r=[...new Set(e.values())].join(", "),o=r===""?"No active controller takes positions, and no joint_state_publisher runs: no sliders.":`Sliders command ${r}: the robot moves.`;return B("p",{class:"fine"},`${i} ${o}`)}tools(t){let e=i=>{for(let r of t)this.rows.get(r.name)?.set(i(r)),this.want(r.name,i(r))},n=({lower:i,upper:r})=>i+Math.random()*(r-i);return B("div",{class:"tools"},$e("Randomize",()=>e(n)),$e("Center",()=>e(({zero:i})=>i)))}row(t,e){let n=t.kind!=="prismatic",[i,r]=n?["rad","rad/s"]:["m","m/s"],o=B("span",{class:"fine"},"\u2013"),a=({position:c,velocity:h,commanded:u})=>{let d=n?[Sc(c)]:[],f=Number.isNaN(h)?[]:[`${we(h,2)} ${r}`],m=Number.isNaN(u)?[]:[`commanded ${we(u,2)}`];return[...d,...f,...m].join("  ")},l=B("span",{class:"joint-name",title:vS(t,i)},t.name);if(!e){let c=B("span",{class:"value"},"\u2013"),h=t.follows===null?"":`follows ${t.follows}`;this.rows.set(t.name,{show:d=>{he(c,`${we(d.position,3)} ${i}`),he(o,a(d))},set:()=>{}});let u=B("span",{class:"fine limits"},Fc(t));return B("div",{class:"joint",title:h},l,c,o,u)}return this.sliderRow(t,i,l,o,a)}sliderRow(t,e,n,i,r){let{name:o,lower:a,upper:l,zero:c}=t,h={min:a,max:l,value:c},u=B("input",{type:"range",...h,step:"any","aria-label":`${o}, ${e}`}),d=B("input",{type:"number",...h,step:.01,"aria-label":`${o}, value in ${e}`}),f=-1/0,m=p=>{u.valueAsNumber=p,d.value=Qg(p)};u.addEventListener("input",()=>{f=performance.now(),d.value=Qg(u.valueAsNumber),this.want(o,u.valueAsNumber)}),d.addEventListener("change",()=>{let p=d.valueAsNumber,g=Number.isNaN(p)?c:Math.min(l,Math.max(a,p));f=performance.now(),m(g),this.want(o,g)}),this.rows.set(o,{set:m,show:p=>{he(i,r(p)),!(u.matches(":active")||document.activeElement===d||performance.now()-f<(this.isDirect?0:_S))&&Number.isFinite(p.position)&&!this.isSending&&m(p.position)}});let y=B("span",{class:"fine limits"},Fc(t));return B("div",{class:"joint slides"},n,d,u,i,y)}get isDirect(){return this.app.store.robot?.joint_publisher!=null}want(t,e){if(this.wanted[t]=e,this.isSending)return;this.isSending=!0;let n=this.isDirect?0:this.sentAt+xS-performance.now();setTimeout(()=>requestAnimationFrame(()=>this.send()),Math.max(0,n))}send(){this.isSending=!1,this.sentAt=performance.now();let t=this.app.store.robot;if(t!==null){let e={...this.wanted};this.app.connection.send({type:"set_joints",robot:t.id,positions:e})}for(let e of Object.keys(this.wanted))delete this.wanted[e]}};function Qg(s){return s.toFixed(3).replace(/^-(0\.0*)$/,"$1")}function Fc({kind:s,lower:t,upper:e}){let n=s==="prismatic"?3:2,i=`${we(t,n)} \u2026 ${we(e,n)}`;return s==="continuous"?"no limits":i}function vS(s,t){let e=s.kind==="continuous"?Fc(s):`${Fc(s)} ${t}`;return`${s.name}: ${s.kind}, ${e}`}function Ja(s,t){let e=URL.createObjectURL(t);B("a",{href:e,download:s}).click(),setTimeout(()=>URL.revokeObjectURL(e),1e4)}var t0={error:"Error",warning:"Warning",note:"Note"},Uc=class{constructor(t){this.app=t;t.store.watch(["model","graph","robot"],()=>this.show())}app;id="model";title="Model";element=B("div",{});get toLookAt(){return(this.app.store.model?.findings??[]).filter(({level:e})=>e!=="note").length}show(){let{store:t}=this.app,{model:e,robot:n}=t;if(n===null||e===null){this.element.replaceChildren(B("p",{class:"empty"},t.graph?.hint??"No robot description yet."));return}let i=[["Command",n.command?.topic??null],["Odometry",n.odometry],["Truth",n.truth],["Joint states",n.joint_states],["Wheels",n.wheels],["Controller manager",n.manager]];this.element.replaceChildren(Tn("Description",gf(bS(e,n.name,n.id))),Tn("Findings of check_urdf",SS(e.findings)),Tn("In the ROS graph",gf(i.map(([r,o])=>[r,o??"nobody publishes it"]))),Tn("URDF",MS(e,n.name)))}};function bS(s,t,e){let n=new DOMParser().parseFromString(s.urdf,"text/xml"),i=[...n.querySelectorAll("robot > link")],r=[...n.querySelectorAll("robot > joint")],a=i.map(l=>Number(l.querySelector("inertial > mass")?.getAttribute("value")??0)).reduce((l,c)=>l+c,0);return[["Name",t],["Namespace",e],["Root link",s.root],["Links",String(i.length)],["Joints",`${r.length}, of which ${s.joints.length} move`],["Mass",`${Number(a.toFixed(3))} kg`]]}function SS(s){if(s.length===0)return B("p",{class:"verdict","data-tone":"good"},"No errors, no warnings.");let t=s.map(({level:e,line:n,text:i,remedy:r})=>B("li",{"data-tone":e},B("p",{},B("b",{},n===null?t0[e]:`${t0[e]}, line ${n}`)),B("p",{},i),r===""?null:B("p",{class:"fine"},r)));return B("ul",{class:"findings"},...t)}function MS(s,t){let e=B("button",{type:"button",class:"button quiet"},"Save the URDF");return e.addEventListener("click",()=>{Ja(`${t}.urdf`,new Blob([s.urdf],{type:"application/xml"}))}),B("details",{class:"source"},B("summary",{},`${s.urdf.split(`
`).length} lines`),B("pre",{tabindex:0},s.urdf),e)}var Bc=class{element=B("canvas",{class:"camera",role:"img"});counts={drawn:0,bad:0};isBusy=!1;next=null;last=null;constructor(t){this.element.setAttribute("aria-label",`Picture of ${t}`),this.element.hidden=!0}show(t){t!==this.last&&(this.last=this.next=t,this.isBusy||this.drawAll())}async drawAll(){for(this.isBusy=!0;this.next!==null;){let{head:t,bytes:e}=this.next;this.next=null;try{this.draw(await createImageBitmap(new Blob([e],{type:t.format})))}catch{this.counts.bad+=1}}this.isBusy=!1}draw(t){let{width:e,height:n}=t;(this.element.width!==e||this.element.height!==n)&&(this.element.width=e,this.element.height=n),this.element.getContext("2d")?.drawImage(t,0,0),this.element.hidden=!1,this.counts.drawn+=1,t.close()}};var wS=.5,TS=3600;function e0({head:s},t){let{rate:e,stamp:n}=s.origin,i=e===null?"\u2013":`${we(e,e<10?1:0)} Hz`,r=t-n;return s.type!=="unreadable"&&Math.abs(r)<TS?`${i} \xB7 ${we(Math.max(0,r),2)} s old`:i}function n0({head:s,floats:t},e){switch(s.type){case"scan":return`${s.count} rays \xB7 ${AS(t,s.range_min,s.range_max)}`;case"cloud":return`${s.count} points`;case"picture":return ES(s);case"range":return CS(t[0]);case"contacts":return RS(s,e-s.origin.stamp>wS);case"unreadable":return s.text}}function AS(s,t,e){let n=1/0;for(let i of s)i<n&&i>=(t??-1/0)&&i<=(e??1/0)&&(n=i);return n===1/0?"nothing in range":`nearest ${we(n,2)} m`}function ES({width:s,height:t,encoding:e,low:n,high:i}){let r=`${s} \xD7 ${t} ${e}`;return n===null||i===null?r:`${r} \xB7 ${we(n,2)} to ${we(i,2)} m`}function CS(s){return s===1/0?"nothing in range":s===-1/0?"too near":`${we(s,3)} m`}function RS({contacts:s},t){return s.length===0||t?"touches nothing":s.map(({first:e,second:n,force:i})=>{let r=i===null?"":` (${we(i,1)} N)`;return`${e} touches ${n}${r}`}).join("; ")}var kc=class{constructor({store:t},e){this.sensing=e;this.element.append(this.list,B("p",{class:"fine"},"What is off is not subscribed: nobody has to measure it.")),t.watch(["graph","robot"],()=>this.build())}sensing;id="sensors";title="Sensors";element=B("div",{});list=B("ul",{class:"rows sensors"});rows=[];signature="";get topics(){return this.sensing.shown.map(({topic:t})=>t)}get drawn(){let t=this.rows.flatMap(({info:e,canvas:n})=>n===null?[]:[[e.topic,n.counts.drawn]]);return Object.fromEntries(t)}pulse(t){for(let e of this.rows){let n=this.sensing.latest.get(e.info.topic);n!==void 0&&(he(e.timing,e0(n,t.time)),this.showMeasured(e,n,t))}}showMeasured(t,e,n){let{head:i}=e;t.words.dataset.tone=i.type==="unreadable"?"warning":"",he(t.words,this.homeless(t.info,e,n)??n0(e,n.time)),i.type==="picture"&&t.canvas?.show(e)}homeless({kind:t,robot:e},{head:n},{layout:i}){if(t==="picture"||n.type==="unreadable"||n.origin.frame==="world")return null;let{frame:r}=n.origin,o=[r,`${e.slice(1)}/${r}`];return i.frames.some(({name:l,parent:c})=>o.includes(l)||o.includes(c))?null:`its frame "${r}" is not in TF, so that it has no place in the view`}build(){let t=this.sensing.here,e=JSON.stringify(t);if(e===this.signature)return;this.signature=e;let n=new Map(this.rows.map(i=>[JSON.stringify(i.info),i]));this.rows=t.map(i=>n.get(JSON.stringify(i))??this.row(i)),this.list.replaceChildren(...this.rows.map(({element:i})=>i)),this.rows.length===0&&this.list.replaceChildren(B("li",{class:"empty"},"No sensor of this robot publishes: no scan, cloud, picture, range or contact."))}row(t){let{topic:e,kind:n,message:i}=t,r=e.replace(/\/compressed$/,""),o=B("button",{type:"button",role:"switch",class:"switch","aria-label":`Show ${e}`}),a={info:t,knob:o,element:B("li",{class:"unit sensor"}),timing:B("span",{class:"fine"}),words:B("span",{class:"fine measured"}),canvas:n==="picture"?new Bc(e):null};return o.addEventListener("click",()=>{this.sensing.set(e,!this.sensing.isOn(t)),this.showSwitch(a)}),a.element.append(B("span",{class:"unit-name",title:`${e} (${i})`},r),B("span",{class:"chip",title:i},i.split("/").at(-1)??i),o,a.timing,a.words),a.canvas!==null&&a.element.append(a.canvas.element),this.showSwitch(a),a}showSwitch({info:t,knob:e,timing:n,words:i,canvas:r}){let o=this.sensing.isOn(t);e.setAttribute("aria-checked",String(o)),e.title=o?"Hide it":"Show it",he(n,o?"nothing has come yet":""),he(i,""),r!==null&&(r.element.hidden=!0)}};var PS=[.1,.25,.5,1,2,5,0],LS=.95,zc=class{constructor(t){this.app=t;this.wanted.append(...PS.map(e=>B("option",{value:e},e===0?"as fast as possible":`${e}\xD7`))),this.wanted.addEventListener("change",()=>{this.ask({type:"set_factor",factor:Number(this.wanted.value)})}),this.body.append(Tn("Clock",this.clock(),this.tools()),Tn("In the world",this.entities),Tn("Another robot like this one",this.spawnForm())),this.element.append(this.none,this.body),t.store.watch(["graph","simulation"],()=>this.show()),t.store.watch(["graph"],()=>this.showEntities())}app;id="simulation";title="Simulation";element=B("div",{});body=B("div",{});none=B("p",{class:"empty"},"There is no simulator in the graph.");time=B("dd",{},"\u2013");state=B("dd",{},"\u2013");real=B("dd",{},"\u2013");steps=B("input",{type:"number",id:"steps",min:1,max:1e4,value:10});wanted=B("select",{id:"factor"});entities=B("ul",{class:"rows"});signature=null;pulse(t){he(this.time,Vr(t.time))}ask(t){let e=this.app.store.simulator;e!==null&&Hr(this.app,{...t,simulator:e.id})}show(){let{simulator:t,simulation:e}=this.app.store;if(this.none.hidden=t!==null,this.body.hidden=t===null,e===null)return;let{factor:n,real_factor:i,state:r}=e;he(this.state,r),he(this.real,r==="playing"?Mc(i):"\u2013");let a=r==="playing"&&n!==null&&n>0&&i!==null&&i<LS*n;this.real.dataset.tone=a?"warning":"calm",this.real.title=a?"This machine is too slow for it.":"",n!==null&&document.activeElement!==this.wanted&&this.showFactor(n)}showFactor(t){let e=String(t);[...this.wanted.options].some(n=>n.value===e)||this.wanted.append(B("option",{value:e},`${e}\xD7`)),this.wanted.value=e}clock(){let t=(e,n)=>B("div",{},B("dt",{},e),n);return B("dl",{class:"facts"},t("Time",this.time),t("State",this.state),t("Real-time factor",this.real))}tools(){let t=()=>this.ask({type:"step",steps:this.steps.valueAsNumber||1});return B("div",{class:"form"},B("label",{class:"field"},B("span",{},"Factor wanted"),this.wanted),B("div",{class:"field"},B("label",{for:"steps"},"Steps"),B("span",{class:"join"},this.steps,$e("Step",t,{icon:"step"}))))}showEntities(){let t=this.app.store.simulator?.entities??[],e=t.join();e!==this.signature&&(this.signature=e,this.entities.replaceChildren(...t.map(n=>this.entity(n))))}entity(t){let e=_g("Delete","Really delete?",()=>this.ask({type:"delete",name:t}));return e.title=`Take ${t} out of the world`,B("li",{},B("span",{class:"grow"},t),e)}spawnForm(){let t=(r,o,a)=>B("label",{class:"field"},B("span",{},o),B("input",{type:"number",name:r,value:a,step:"any",required:!0})),n=B("input",{type:"text",name:"name",required:!0,pattern:"[A-Za-z]\\w*"}),i=B("form",{class:"form spawn"},B("label",{class:"field wide"},B("span",{},"Name"),n),t("x","x, m",1),t("y","y, m",0),t("yaw","Yaw, \xB0",0),B("button",{type:"submit",class:"button primary"},"Spawn"));return i.addEventListener("submit",r=>{r.preventDefault(),this.spawn(new FormData(i))}),this.app.store.watch(["graph"],()=>{document.activeElement!==n&&(n.value=IS(this.app.store.simulator?.entities??[]))}),i}spawn(t){let{simulator:e,robot:n}=this.app.store,i=r=>String(t.get(r)??"");if(e===null||n===null){this.app.store.note("error","There is no robot here to make another one like it.");return}Hr(this.app,{type:"spawn",simulator:e.id,name:i("name"),namespace:`/${i("name")}`,position:[Number(i("x")),Number(i("y")),0],yaw:Number(i("yaw"))*Math.PI/180,like:n.id})}};function IS(s){let t=1;for(;s.includes(`robot${t}`);)t+=1;return`robot${t}`}var NS="uplot",DS="u-hz",OS="u-vt",FS="u-title",US="u-wrap",BS="u-under",kS="u-over",zS="u-axis",jr="u-off",VS="u-select",GS="u-cursor-x",HS="u-cursor-y",WS="u-cursor-pt",XS="u-legend",qS="u-live",jS="u-inline",YS="u-series",$S="u-marker",i0="u-label",JS="u-value",Za="width",Qa="height";var s0="bottom",Oo="left",Mf="right",zf="#000",r0=zf+"0",wf="mousemove",o0="mousedown",Tf="mouseup",a0="mouseenter",l0="mouseleave",c0="dblclick",KS="resize",ZS="scroll",h0="change",Xc="dppxchange",Vf="--",Go=typeof window<"u",Pf=Go?document:null,Uo=Go?window:null,QS=Go?navigator:null,Pe,Vc;function Lf(){let s=devicePixelRatio;Pe!=s&&(Pe=s,Vc&&Nf(h0,Vc,Lf),Vc=matchMedia(`(min-resolution: ${Pe-.001}dppx) and (max-resolution: ${Pe+.001}dppx)`),Yr(h0,Vc,Lf),Uo.dispatchEvent(new CustomEvent(Xc)))}function Pi(s,t){if(t!=null){let e=s.classList;!e.contains(t)&&e.add(t)}}function If(s,t){let e=s.classList;e.contains(t)&&e.remove(t)}function Je(s,t,e){s.style[t]=e+"px"}function es(s,t,e,n){let i=Pf.createElement(s);return t!=null&&Pi(i,t),e?.insertBefore(i,n),i}function Hi(s,t){return es("div",s,t)}var u0=new WeakMap;function vs(s,t,e,n,i){let r="translate("+t+"px,"+e+"px)",o=u0.get(s);r!=o&&(s.style.transform=r,u0.set(s,r),t<0||e<0||t>n||e>i?Pi(s,jr):If(s,jr))}var d0=new WeakMap;function f0(s,t,e){let n=t+e,i=d0.get(s);n!=i&&(d0.set(s,n),s.style.background=t,s.style.borderColor=e)}var p0=new WeakMap;function m0(s,t,e,n){let i=t+""+e,r=p0.get(s);i!=r&&(p0.set(s,i),s.style.height=e+"px",s.style.width=t+"px",s.style.marginLeft=n?-t/2+"px":0,s.style.marginTop=n?-e/2+"px":0)}var Gf={passive:!0},tM={...Gf,capture:!0};function Yr(s,t,e,n){t.addEventListener(s,e,n?tM:Gf)}function Nf(s,t,e,n){t.removeEventListener(s,e,Gf)}Go&&Lf();function ns(s,t,e,n){let i;e=e||0,n=n||t.length-1;let r=n<=2147483647;for(;n-e>1;)i=r?e+n>>1:Li((e+n)/2),t[i]<s?e=i:n=i;return s-t[e]<=t[n]-s?e:n}function H0(s){return(e,n,i)=>{let r=-1,o=-1;for(let a=n;a<=i;a++)if(s(e[a])){r=a;break}for(let a=i;a>=n;a--)if(s(e[a])){o=a;break}return[r,o]}}var W0=s=>s!=null,X0=s=>s!=null&&s>0,Yc=H0(W0),eM=H0(X0);function nM(s,t,e,n=0,i=!1){let r=i?eM:Yc,o=i?X0:W0;[t,e]=r(s,t,e);let a=s[t],l=s[t];if(t>-1)if(n==1)a=s[t],l=s[e];else if(n==-1)a=s[e],l=s[t];else for(let c=t;c<=e;c++){let h=s[c];o(h)&&(h<a?a=h:h>l&&(l=h))}return[a??ze,l??-ze]}function $c(s,t,e,n){let i=_0(s),r=_0(t);s==t&&(i==-1?(s*=e,t/=e):(s/=e,t*=e));let o=e==10?zs:q0,a=i==1?Li:Wi,l=r==1?Wi:Li,c=a(o(En(s))),h=l(o(En(t))),u=Bo(e,c),d=Bo(e,h);return e==10&&(c<0&&(u=Ve(u,-c)),h<0&&(d=Ve(d,-h))),n||e==2?(s=u*i,t=d*r):(s=J0(s,u),t=Jc(t,d)),[s,t]}function Hf(s,t,e,n){let i=$c(s,t,e,n);return s==0&&(i[0]=0),t==0&&(i[1]=0),i}var Wf=.1,g0={mode:3,pad:Wf},el={pad:0,soft:null,mode:0},iM={min:el,max:el};function qc(s,t,e,n){return Kc(e)?y0(s,t,e):(el.pad=e,el.soft=n?0:null,el.mode=n?3:0,y0(s,t,iM))}function Ce(s,t){return s??t}function sM(s,t,e){for(t=Ce(t,0),e=Ce(e,s.length-1);t<=e;){if(s[t]!=null)return!0;t++}return!1}function y0(s,t,e){let n=e.min,i=e.max,r=Ce(n.pad,0),o=Ce(i.pad,0),a=Ce(n.hard,-ze),l=Ce(i.hard,ze),c=Ce(n.soft,ze),h=Ce(i.soft,-ze),u=Ce(n.mode,0),d=Ce(i.mode,0),f=t-s,m=zs(f),y=di(En(s),En(t)),p=zs(y),g=En(p-m);(f<1e-24||g>10)&&(f=0,(s==0||t==0)&&(f=1e-24,u==2&&c!=ze&&(r=0),d==2&&h!=-ze&&(o=0)));let _=f||y||1e3,w=zs(_),v=Bo(10,Li(w)),A=_*(f==0?s==0?.1:1:r),S=Ve(J0(s-A,v/10),24),x=s>=c&&(u==1||u==3&&S<=c||u==2&&S>=c)?c:ze,M=di(a,S<x&&s>=x?x:is(x,S)),L=_*(f==0?t==0?.1:1:o),P=Ve(Jc(t+L,v/10),24),R=t<=h&&(d==1||d==3&&P>=h||d==2&&P<=h)?h:-ze,O=is(l,P>R&&t<=R?R:di(R,P));return M==O&&M==0&&(O=100),[M,O]}var rM=new Intl.NumberFormat(Go?QS.language:"en-US"),Xf=s=>rM.format(s),Ii=Math,Wc=Ii.PI,En=Ii.abs,Li=Ii.floor,An=Ii.round,Wi=Ii.ceil,is=Ii.min,di=Ii.max,Bo=Ii.pow,_0=Ii.sign,zs=Ii.log10,q0=Ii.log2,oM=(s,t=1)=>Ii.sinh(s)*t,Af=(s,t=1)=>Ii.asinh(s/t),ze=1/0;function x0(s){return(zs((s^s>>31)-(s>>31))|0)+1}function Df(s,t,e){return is(di(s,t),e)}function j0(s){return typeof s=="function"}function be(s){return j0(s)?s:()=>s}var aM=()=>{},Y0=s=>s,$0=(s,t)=>t,lM=s=>null,v0=s=>!0,b0=(s,t)=>s==t,cM=/\.\d*?(?=9{6,}|0{6,})/gm,$r=s=>{if(Z0(s)||_r.has(s))return s;let t=`${s}`,e=t.match(cM);if(e==null)return s;let n=e[0].length-1;if(t.indexOf("e-")!=-1){let[i,r]=t.split("e");return+`${$r(i)}e${r}`}return Ve(s,n)};function Xr(s,t){return $r(Ve($r(s/t))*t)}function Jc(s,t){return $r(Wi($r(s/t))*t)}function J0(s,t){return $r(Li($r(s/t))*t)}function Ve(s,t=0){if(Z0(s))return s;let e=10**t,n=s*e*(1+Number.EPSILON);return An(n)/e}var _r=new Map;function K0(s){return((""+s).split(".")[1]||"").length}function il(s,t,e,n){let i=[],r=n.map(K0);for(let o=t;o<e;o++){let a=En(o),l=Ve(Bo(s,o),a);for(let c=0;c<n.length;c++){let h=s==10?+`${n[c]}e${o}`:n[c]*l,u=(o>=0?0:a)+(o>=r[c]?0:r[c]),d=s==10?h:Ve(h,u);i.push(d),_r.set(d,u)}}return i}var nl={},qf=[],ko=[null,null],yr=Array.isArray,Z0=Number.isInteger,hM=s=>s===void 0;function S0(s){return typeof s=="string"}function Kc(s){let t=!1;if(s!=null){let e=s.constructor;t=e==null||e==Object}return t}function uM(s){return s!=null&&typeof s=="object"}var dM=Object.getPrototypeOf(Uint8Array),Q0="__proto__";function zo(s,t=Kc){let e;if(yr(s)){let n=s.find(i=>i!=null);if(yr(n)||t(n)){e=Array(s.length);for(let i=0;i<s.length;i++)e[i]=zo(s[i],t)}else e=s.slice()}else if(s instanceof dM)e=s.slice();else if(t(s)){e={};for(let n in s)n!=Q0&&(e[n]=zo(s[n],t))}else e=s;return e}function vn(s){let t=arguments;for(let e=1;e<t.length;e++){let n=t[e];for(let i in n)i!=Q0&&(Kc(s[i])?vn(s[i],zo(n[i])):s[i]=zo(n[i]))}return s}var fM=0,pM=1,mM=2;function gM(s,t,e){for(let n=0,i,r=-1;n<t.length;n++){let o=t[n];if(o>r){for(i=o-1;i>=0&&s[i]==null;)s[i--]=null;for(i=o+1;i<e&&s[i]==null;)s[r=i++]=null}}}function yM(s,t){if(vM(s)){let o=s[0].slice();for(let a=1;a<s.length;a++)o.push(...s[a].slice(1));return bM(o[0])||(o=xM(o)),o}let e=new Set;for(let o=0;o<s.length;o++){let l=s[o][0],c=l.length;for(let h=0;h<c;h++)e.add(l[h])}let n=[Array.from(e).sort((o,a)=>o-a)],i=n[0].length,r=new Map;for(let o=0;o<i;o++)r.set(n[0][o],o);for(let o=0;o<s.length;o++){let a=s[o],l=a[0];for(let c=1;c<a.length;c++){let h=a[c],u=Array(i).fill(void 0),d=t?t[o][c]:pM,f=[];for(let m=0;m<h.length;m++){let y=h[m],p=r.get(l[m]);y===null?d!=fM&&(u[p]=y,d==mM&&f.push(p)):u[p]=y}gM(u,f,i),n.push(u)}}return n}var _M=typeof queueMicrotask>"u"?s=>Promise.resolve().then(s):queueMicrotask;function xM(s){let t=s[0],e=t.length,n=Array(e);for(let r=0;r<n.length;r++)n[r]=r;n.sort((r,o)=>t[r]-t[o]);let i=[];for(let r=0;r<s.length;r++){let o=s[r],a=Array(e);for(let l=0;l<e;l++)a[l]=o[n[l]];i.push(a)}return i}function vM(s){let t=s[0][0],e=t.length;for(let n=1;n<s.length;n++){let i=s[n][0];if(i.length!=e)return!1;if(i!=t){for(let r=0;r<e;r++)if(i[r]!=t[r])return!1}}return!0}function bM(s,t=100){let e=s.length;if(e<=1)return!0;let n=0,i=e-1;for(;n<=i&&s[n]==null;)n++;for(;i>=n&&s[i]==null;)i--;if(i<=n)return!0;let r=di(1,Li((i-n+1)/t));for(let o=s[n],a=n+r;a<=i;a+=r){let l=s[a];if(l!=null){if(l<=o)return!1;o=l}}return!0}var ty=["January","February","March","April","May","June","July","August","September","October","November","December"],ey=["Sunday","Monday","Tuesday","Wednesday","Thursday","Friday","Saturday"];function ny(s){return s.slice(0,3)}var SM=ey.map(ny),MM=ty.map(ny),wM={MMMM:ty,MMM:MM,WWWW:ey,WWW:SM};function Ka(s){return(s<10?"0":"")+s}function TM(s){return(s<10?"00":s<100?"0":"")+s}var AM={YYYY:s=>s.getFullYear(),YY:s=>(s.getFullYear()+"").slice(2),MMMM:(s,t)=>t.MMMM[s.getMonth()],MMM:(s,t)=>t.MMM[s.getMonth()],MM:s=>Ka(s.getMonth()+1),M:s=>s.getMonth()+1,DD:s=>Ka(s.getDate()),D:s=>s.getDate(),WWWW:(s,t)=>t.WWWW[s.getDay()],WWW:(s,t)=>t.WWW[s.getDay()],HH:s=>Ka(s.getHours()),H:s=>s.getHours(),h:s=>{let t=s.getHours();return t==0?12:t>12?t-12:t},AA:s=>s.getHours()>=12?"PM":"AM",aa:s=>s.getHours()>=12?"pm":"am",a:s=>s.getHours()>=12?"p":"a",mm:s=>Ka(s.getMinutes()),m:s=>s.getMinutes(),ss:s=>Ka(s.getSeconds()),s:s=>s.getSeconds(),fff:s=>TM(s.getMilliseconds())};function jf(s,t){t=t||wM;let e=[],n=/\{([a-z]+)\}|[^{]+/gi,i;for(;i=n.exec(s);)e.push(i[0][0]=="{"?AM[i[1]]:i[0]);return r=>{let o="";for(let a=0;a<e.length;a++)o+=typeof e[a]=="string"?e[a]:e[a](r,t);return o}}var EM=new Intl.DateTimeFormat().resolvedOptions().timeZone;function CM(s,t){let e;return t=="UTC"||t=="Etc/UTC"?e=new Date(+s+s.getTimezoneOffset()*6e4):t==EM?e=s:(e=new Date(s.toLocaleString("en-US",{timeZone:t})),e.setMilliseconds(s.getMilliseconds())),e}var iy=s=>s%1==0,jc=[1,2,2.5,5],RM=il(10,-32,0,jc),sy=il(10,0,32,jc),PM=sy.filter(iy),qr=RM.concat(sy),Yf=`
`,ry="{YYYY}",M0=Yf+ry,oy="{M}/{D}",tl=Yf+oy,Gc=tl+"/{YY}",ay="{aa}",LM="{h}:{mm}",Fo=LM+ay,w0=Yf+Fo,T0=":{ss}",Ie=null;function ly(s){let t=s*1e3,e=t*60,n=e*60,i=n*24,r=i*30,o=i*365,l=(s==1?il(10,0,3,jc).filter(iy):il(10,-3,0,jc)).concat([t,t*5,t*10,t*15,t*30,e,e*5,e*10,e*15,e*30,n,n*2,n*3,n*4,n*6,n*8,n*12,i,i*2,i*3,i*4,i*5,i*6,i*7,i*8,i*9,i*10,i*15,r,r*2,r*3,r*4,r*6,o,o*2,o*5,o*10,o*25,o*50,o*100]),c=[[o,ry,Ie,Ie,Ie,Ie,Ie,Ie,1],[i*28,"{MMM}",M0,Ie,Ie,Ie,Ie,Ie,1],[i,oy,M0,Ie,Ie,Ie,Ie,Ie,1],[n,"{h}"+ay,Gc,Ie,tl,Ie,Ie,Ie,1],[e,Fo,Gc,Ie,tl,Ie,Ie,Ie,1],[t,T0,Gc+" "+Fo,Ie,tl+" "+Fo,Ie,w0,Ie,1],[s,T0+".{fff}",Gc+" "+Fo,Ie,tl+" "+Fo,Ie,w0,Ie,1]];function h(u){return(d,f,m,y,p,g)=>{let _=[],w=p>=o,v=p>=r&&p<o,A=u(m),S=Ve(A*s,3),x=Ef(A.getFullYear(),w?0:A.getMonth(),v||w?1:A.getDate()),M=Ve(x*s,3);if(v||w){let L=v?p/r:0,P=w?p/o:0,R=S==M?S:Ve(Ef(x.getFullYear()+P,x.getMonth()+L,1)*s,3),O=new Date(An(R/s)),k=O.getFullYear(),N=O.getMonth();for(let W=0;R<=y;W++){let z=Ef(k+P*W,N+L*W,1),H=z-u(Ve(z*s,3));R=Ve((+z+H)*s,3),R<=y&&_.push(R)}}else{let L=p>=i?i:p,P=Li(m)-Li(S),R=M+P+Jc(S-M,L);_.push(R);let O=u(R),k=O.getHours()+O.getMinutes()/e+O.getSeconds()/n,N=p/n,W=d.axes[f]._space,z=g/W;for(;R=Ve(R+p,s==1?0:3),!(R>y);)if(N>1){let H=Li(Ve(k+N,6))%24,K=u(R).getHours()-H;K>1&&(K=-1),R-=K*n,k=(k+N)%24;let tt=_[_.length-1];Ve((R-tt)/p,3)*z>=.7&&_.push(R)}else _.push(R)}return _}}return[l,c,h]}var[IM,NM,DM]=ly(1),[OM,FM,UM]=ly(.001);il(2,-53,53,[1]);function A0(s,t){return s.map(e=>e.map((n,i)=>i==0||i==8||n==null?n:t(i==1||e[8]==0?n:e[1]+n)))}function E0(s,t){return(e,n,i,r,o)=>{let a=t.find(m=>o>=m[0])||t[t.length-1],l,c,h,u,d,f;return n.map(m=>{let y=s(m),p=y.getFullYear(),g=y.getMonth(),_=y.getDate(),w=y.getHours(),v=y.getMinutes(),A=y.getSeconds(),S=p!=l&&a[2]||g!=c&&a[3]||_!=h&&a[4]||w!=u&&a[5]||v!=d&&a[6]||A!=f&&a[7]||a[1];return l=p,c=g,h=_,u=w,d=v,f=A,S(y)})}}function BM(s,t){let e=jf(t);return(n,i,r,o,a)=>i.map(l=>e(s(l)))}function Ef(s,t,e){return new Date(s,t,e)}function C0(s,t){return t(s)}var kM="{YYYY}-{MM}-{DD} {h}:{mm}{aa}";function R0(s,t){return(e,n,i,r)=>r==null?Vf:t(s(n))}function zM(s,t){let e=s.series[t];return e.width?e.stroke(s,t):e.points.width?e.points.stroke(s,t):null}function VM(s,t){return s.series[t].fill(s,t)}var GM={show:!0,live:!0,isolate:!1,mount:aM,markers:{show:!0,width:2,stroke:zM,fill:VM,dash:"solid"},idx:null,idxs:null,values:[]};function HM(s,t){let e=s.cursor.points,n=Hi(),i=e.size(s,t);Je(n,Za,i),Je(n,Qa,i);let r=i/-2;Je(n,"marginLeft",r),Je(n,"marginTop",r);let o=e.width(s,t,i);return o&&Je(n,"borderWidth",o),n}function WM(s,t){let e=s.series[t].points;return e._fill||e._stroke}function XM(s,t){let e=s.series[t].points;return e._stroke||e._fill}function qM(s,t){return s.series[t].points.size}var Cf=[0,0];function jM(s,t,e){return Cf[0]=t,Cf[1]=e,Cf}function Hc(s,t,e,n=!0){return i=>{i.button==0&&(!n||i.target==t)&&e(i)}}function Rf(s,t,e,n=!0){return i=>{(!n||i.target==t)&&e(i)}}var YM={show:!0,x:!0,y:!0,lock:!1,move:jM,points:{one:!1,show:HM,size:qM,width:0,stroke:XM,fill:WM},bind:{mousedown:Hc,mouseup:Hc,click:Hc,dblclick:Hc,mousemove:Rf,mouseleave:Rf,mouseenter:Rf},drag:{setScale:!0,x:!0,y:!1,dist:0,uni:null,click:(s,t)=>{t.stopPropagation(),t.stopImmediatePropagation()},_x:!1,_y:!1},focus:{dist:(s,t,e,n,i)=>n-i,prox:-1,bias:0},hover:{skip:[void 0],prox:null,bias:0},left:-10,top:-10,idx:null,dataIdx:null,idxs:null,event:null},cy={show:!0,stroke:"rgba(0,0,0,0.07)",width:2},$f=vn({},cy,{filter:$0}),hy=vn({},$f,{size:10}),uy=vn({},cy,{show:!1}),Jf='12px system-ui, -apple-system, "Segoe UI", Roboto, "Helvetica Neue", Arial, "Noto Sans", sans-serif, "Apple Color Emoji", "Segoe UI Emoji", "Segoe UI Symbol", "Noto Color Emoji"',dy="bold "+Jf,fy=1.5,P0={show:!0,scale:"x",stroke:zf,space:50,gap:5,alignTo:1,size:50,labelGap:0,labelSize:30,labelFont:dy,side:2,grid:$f,ticks:hy,border:uy,font:Jf,lineGap:fy,rotate:0},$M="Value",JM="Time",L0={show:!0,scale:"x",auto:!1,sorted:1,min:ze,max:-ze,idxs:[]};function KM(s,t,e,n,i){return t.map(r=>r==null?"":Xf(r))}function ZM(s,t,e,n,i,r,o){let a=[],l=_r.get(i)||0;e=o?e:Ve(Jc(e,i),l);for(let c=e;c<=n;c=Ve(c+i,l))a.push(Object.is(c,-0)?0:c);return a}function Of(s,t,e,n,i,r,o){let a=[],l=s.scales[s.axes[t].scale].log,c=l==10?zs:q0,h=Li(c(e));i=Bo(l,h),l==10&&(i=qr[ns(i,qr)]);let u=e,d=i*l;l==10&&(d=qr[ns(d,qr)]);do a.push(u),u=u+i,l==10&&!_r.has(u)&&(u=Ve(u,_r.get(i))),u>=d&&(i=u,d=i*l,l==10&&(d=qr[ns(d,qr)]));while(u<=n);return a}function QM(s,t,e,n,i,r,o){let l=s.scales[s.axes[t].scale].asinh,c=n>l?Of(s,t,di(l,e),n,i):[l],h=n>=0&&e<=0?[0]:[];return(e<-l?Of(s,t,di(l,-n),-e,i):[l]).reverse().map(d=>-d).concat(h,c)}var py=/./,tw=/[12357]/,ew=/[125]/,I0=/1/,Ff=(s,t,e,n)=>s.map((i,r)=>t==4&&i==0||r%n==0&&e.test(i.toExponential()[i<0?1:0])?i:null);function nw(s,t,e,n,i){let r=s.axes[e],o=r.scale,a=s.scales[o],l=s.valToPos,c=r._space,h=l(10,o),u=l(9,o)-h>=c?py:l(7,o)-h>=c?tw:l(5,o)-h>=c?ew:I0;if(u==I0){let d=En(l(1,o)-h);if(d<c)return Ff(t.slice().reverse(),a.distr,u,Wi(c/d)).reverse()}return Ff(t,a.distr,u,1)}function iw(s,t,e,n,i){let r=s.axes[e],o=r.scale,a=r._space,l=s.valToPos,c=En(l(1,o)-l(2,o));return c<a?Ff(t.slice().reverse(),3,py,Wi(a/c)).reverse():t}function sw(s,t,e,n){return n==null?Vf:t==null?"":Xf(t)}var N0={show:!0,scale:"y",stroke:zf,space:30,gap:5,alignTo:1,size:50,labelGap:0,labelSize:30,labelFont:dy,side:3,grid:$f,ticks:hy,border:uy,font:Jf,lineGap:fy,rotate:0};function rw(s,t){let e=3+(s||1)*2;return Ve(e*t,3)}function ow(s,t){let{scale:e,idxs:n}=s.series[0],i=s._data[0],r=s.valToPos(i[n[0]],e,!0),o=s.valToPos(i[n[1]],e,!0),a=En(o-r),l=s.series[t],c=a/(l.points.space*Pe);return n[1]-n[0]<=c}var D0={scale:null,auto:!0,sorted:0,min:ze,max:-ze},my=(s,t,e,n,i)=>i,O0={show:!0,auto:!0,sorted:0,gaps:my,alpha:1,facets:[vn({},D0,{scale:"x"}),vn({},D0,{scale:"y"})]},F0={scale:"y",auto:!0,sorted:0,show:!0,spanGaps:!1,gaps:my,alpha:1,points:{show:ow,filter:null},values:null,min:ze,max:-ze,idxs:[],path:null,clip:null};function aw(s,t,e,n,i){return e/10}var gy={time:!0,auto:!0,distr:1,log:10,asinh:1,min:null,max:null,dir:1,ori:0},lw=vn({},gy,{time:!1,ori:1}),U0={};function yy(s,t){let e=U0[s];return e||(e={key:s,plots:[],sub(n){e.plots.push(n)},unsub(n){e.plots=e.plots.filter(i=>i!=n)},pub(n,i,r,o,a,l,c){for(let h=0;h<e.plots.length;h++)e.plots[h]!=i&&e.plots[h].pub(n,i,r,o,a,l,c)}},s!=null&&(U0[s]=e)),e}var Vo=1,Uf=2;function Jr(s,t,e){let n=s.mode,i=s.series[t],r=n==2?s._data[t]:s._data,o=s.scales,a=s.bbox,l=r[0],c=n==2?r[1]:r[t],h=n==2?o[i.facets[0].scale]:o[s.series[0].scale],u=n==2?o[i.facets[1].scale]:o[i.scale],d=a.left,f=a.top,m=a.width,y=a.height,p=s.valToPosH,g=s.valToPosV;return h.ori==0?e(i,l,c,h,u,p,g,d,f,m,y,Qc,Ho,eh,xy,by):e(i,l,c,h,u,g,p,f,d,y,m,th,Wo,Qf,vy,Sy)}function Kf(s,t){let e=0,n=0,i=Ce(s.bands,qf);for(let r=0;r<i.length;r++){let o=i[r];o.series[0]==t?e=o.dir:o.series[1]==t&&(o.dir==1?n|=1:n|=2)}return[e,n==1?-1:n==2?1:n==3?2:0]}function cw(s,t,e,n,i){let r=s.mode,o=s.series[t],a=r==2?o.facets[1].scale:o.scale,l=s.scales[a];return i==-1?l.min:i==1?l.max:l.distr==3?l.dir==1?l.min:l.max:0}function Vs(s,t,e,n,i,r){return Jr(s,t,(o,a,l,c,h,u,d,f,m,y,p)=>{let g=o.pxRound,_=c.dir*(c.ori==0?1:-1),w=c.ori==0?Ho:Wo,v,A;_==1?(v=e,A=n):(v=n,A=e);let S=g(u(a[v],c,y,f)),x=g(d(l[v],h,p,m)),M=g(u(a[A],c,y,f)),L=g(d(r==1?h.max:h.min,h,p,m)),P=new Path2D(i);return w(P,M,L),w(P,S,L),w(P,S,x),P})}function Zc(s,t,e,n,i,r){let o=null;if(s.length>0){o=new Path2D;let a=t==0?eh:Qf,l=e;for(let u=0;u<s.length;u++){let d=s[u];if(d[1]>d[0]){let f=d[0]-l;f>0&&a(o,l,n,f,n+r),l=d[1]}}let c=e+i-l,h=10;c>0&&a(o,l,n-h/2,c,n+r+h)}return o}function hw(s,t,e){let n=s[s.length-1];n&&n[0]==t?n[1]=e:s.push([t,e])}function Zf(s,t,e,n,i,r,o){let a=[],l=s.length;for(let c=i==1?e:n;c>=e&&c<=n;c+=i)if(t[c]===null){let u=c,d=c;if(i==1)for(;++c<=n&&t[c]===null;)d=c;else for(;--c>=e&&t[c]===null;)d=c;let f=r(s[u]),m=d==u?f:r(s[d]),y=u-i;f=o<=0&&y>=0&&y<l?r(s[y]):f;let g=d+i;m=o>=0&&g>=0&&g<l?r(s[g]):m,m>=f&&a.push([f,m])}return a}function B0(s){return s==0?Y0:s==1?An:t=>Xr(t,s)}function _y(s){let t=s==0?Qc:th,e=s==0?(i,r,o,a,l,c)=>{i.arcTo(r,o,a,l,c)}:(i,r,o,a,l,c)=>{i.arcTo(o,r,l,a,c)},n=s==0?(i,r,o,a,l)=>{i.rect(r,o,a,l)}:(i,r,o,a,l)=>{i.rect(o,r,l,a)};return(i,r,o,a,l,c=0,h=0)=>{c==0&&h==0?n(i,r,o,a,l):(c=is(c,a/2,l/2),h=is(h,a/2,l/2),t(i,r+c,o),e(i,r+a,o,r+a,o+l,c),e(i,r+a,o+l,r,o+l,h),e(i,r,o+l,r,o,h),e(i,r,o,r+a,o,c),i.closePath())}}var Qc=(s,t,e)=>{s.moveTo(t,e)},th=(s,t,e)=>{s.moveTo(e,t)},Ho=(s,t,e)=>{s.lineTo(t,e)},Wo=(s,t,e)=>{s.lineTo(e,t)},eh=_y(0),Qf=_y(1),xy=(s,t,e,n,i,r)=>{s.arc(t,e,n,i,r)},vy=(s,t,e,n,i,r)=>{s.arc(e,t,n,i,r)},by=(s,t,e,n,i,r,o)=>{s.bezierCurveTo(t,e,n,i,r,o)},Sy=(s,t,e,n,i,r,o)=>{s.bezierCurveTo(e,t,i,n,o,r)};function My(s){return(t,e,n,i,r)=>Jr(t,e,(o,a,l,c,h,u,d,f,m,y,p)=>{let{pxRound:g,points:_}=o,w,v;c.ori==0?(w=Qc,v=xy):(w=th,v=vy);let A=Ve(_.width*Pe,3),S=(_.size-_.width)/2*Pe,x=Ve(S*2,3),M=new Path2D,L=new Path2D,{left:P,top:R,width:O,height:k}=t.bbox;eh(L,P-x,R-x,O+x*2,k+x*2);let N=W=>{if(l[W]!=null){let z=g(u(a[W],c,y,f)),H=g(d(l[W],h,p,m));w(M,z+S,H),v(M,z,H,S,0,Wc*2)}};if(r)r.forEach(N);else for(let W=n;W<=i;W++)N(W);return{stroke:A>0?M:null,fill:M,clip:L,flags:Vo|Uf}})}function wy(s){return(t,e,n,i,r,o)=>{n!=i&&(r!=n&&o!=n&&s(t,e,n),r!=i&&o!=i&&s(t,e,i),s(t,e,o))}}var uw=wy(Ho),dw=wy(Wo);function Ty(s){let t=Ce(s?.alignGaps,0);return(e,n,i,r)=>Jr(e,n,(o,a,l,c,h,u,d,f,m,y,p)=>{[i,r]=Yc(l,i,r);let g=o.pxRound,_=k=>g(u(k,c,y,f)),w=k=>g(d(k,h,p,m)),v,A;c.ori==0?(v=Ho,A=uw):(v=Wo,A=dw);let S=c.dir*(c.ori==0?1:-1),x={stroke:new Path2D,fill:null,clip:null,band:null,gaps:null,flags:Vo},M=x.stroke,L=!1;if(r-i>=y*4){let k=st=>e.posToVal(st,c.key,!0),N=null,W=null,z,H,it,Y=_(a[S==1?i:r]),K=_(a[i]),tt=_(a[r]),ht=k(S==1?K+1:tt-1);for(let st=S==1?i:r;st>=i&&st<=r;st+=S){let j=a[st],nt=(S==1?j<ht:j>ht)?Y:_(j),lt=l[st];nt==Y?lt!=null?(H=lt,N==null?(v(M,nt,w(H)),z=N=W=H):H<N?N=H:H>W&&(W=H)):lt===null&&(L=!0):(N!=null&&A(M,Y,w(N),w(W),w(z),w(H)),lt!=null?(H=lt,v(M,nt,w(H)),N=W=z=H):(N=W=null,lt===null&&(L=!0)),Y=nt,ht=k(Y+S))}N!=null&&N!=W&&it!=Y&&A(M,Y,w(N),w(W),w(z),w(H))}else for(let k=S==1?i:r;k>=i&&k<=r;k+=S){let N=l[k];N===null?L=!0:N!=null&&v(M,_(a[k]),w(N))}let[R,O]=Kf(e,n);if(o.fill!=null||R!=0){let k=x.fill=new Path2D(M),N=o.fillTo(e,n,o.min,o.max,R),W=w(N),z=_(a[i]),H=_(a[r]);S==-1&&([H,z]=[z,H]),v(k,H,W),v(k,z,W)}if(!o.spanGaps){let k=[];L&&k.push(...Zf(a,l,i,r,S,_,t)),x.gaps=k=o.gaps(e,n,i,r,k),x.clip=Zc(k,c.ori,f,m,y,p)}return O!=0&&(x.band=O==2?[Vs(e,n,i,r,M,-1),Vs(e,n,i,r,M,1)]:Vs(e,n,i,r,M,O)),x})}function fw(s){let t=Ce(s.align,1),e=Ce(s.ascDesc,!1),n=Ce(s.alignGaps,0),i=Ce(s.extend,!1);return(r,o,a,l)=>Jr(r,o,(c,h,u,d,f,m,y,p,g,_,w)=>{[a,l]=Yc(u,a,l);let v=c.pxRound,{left:A,width:S}=r.bbox,x=K=>v(m(K,d,_,p)),M=K=>v(y(K,f,w,g)),L=d.ori==0?Ho:Wo,P={stroke:new Path2D,fill:null,clip:null,band:null,gaps:null,flags:Vo},R=P.stroke,O=d.dir*(d.ori==0?1:-1),k=M(u[O==1?a:l]),N=x(h[O==1?a:l]),W=N,z=N;i&&t==-1&&(z=A,L(R,z,k)),L(R,N,k);for(let K=O==1?a:l;K>=a&&K<=l;K+=O){let tt=u[K];if(tt==null)continue;let ht=x(h[K]),st=M(tt);t==1?L(R,ht,k):L(R,W,st),L(R,ht,st),k=st,W=ht}let H=W;i&&t==1&&(H=A+S,L(R,H,k));let[it,Y]=Kf(r,o);if(c.fill!=null||it!=0){let K=P.fill=new Path2D(R),tt=c.fillTo(r,o,c.min,c.max,it),ht=M(tt);L(K,H,ht),L(K,z,ht)}if(!c.spanGaps){let K=[];K.push(...Zf(h,u,a,l,O,x,n));let tt=c.width*Pe/2,ht=e||t==1?tt:-tt,st=e||t==-1?-tt:tt;K.forEach(j=>{j[0]+=ht,j[1]+=st}),P.gaps=K=c.gaps(r,o,a,l,K),P.clip=Zc(K,d.ori,p,g,_,w)}return Y!=0&&(P.band=Y==2?[Vs(r,o,a,l,R,-1),Vs(r,o,a,l,R,1)]:Vs(r,o,a,l,R,Y)),P})}function k0(s,t,e,n,i,r,o=ze){if(s.length>1){let a=null;for(let l=0,c=1/0;l<s.length;l++)if(t[l]!==void 0){if(a!=null){let h=En(s[l]-s[a]);h<c&&(c=h,o=En(e(s[l],n,i,r)-e(s[a],n,i,r)))}a=l}}return o}function pw(s){s=s||nl;let t=Ce(s.size,[.6,ze,1]),e=s.align||0,n=s.gap||0,i=s.radius;i=i==null?[0,0]:typeof i=="number"?[i,0]:i;let r=be(i),o=1-t[0],a=Ce(t[1],ze),l=Ce(t[2],1),c=Ce(s.disp,nl),h=Ce(s.each,f=>{}),{fill:u,stroke:d}=c;return(f,m,y,p)=>Jr(f,m,(g,_,w,v,A,S,x,M,L,P,R)=>{let O=g.pxRound,k=e,N=n*Pe,W=a*Pe,z=l*Pe,H,it;v.ori==0?[H,it]=r(f,m):[it,H]=r(f,m);let Y=v.dir*(v.ori==0?1:-1),K=v.ori==0?eh:Qf,tt=v.ori==0?h:(Pt,Zt,ae,wt,ke,Wt,Jt)=>{h(Pt,Zt,ae,ke,wt,Jt,Wt)},ht=Ce(f.bands,qf).find(Pt=>Pt.series[0]==m),st=ht!=null?ht.dir:0,j=g.fillTo(f,m,g.min,g.max,st),rt=O(x(j,A,R,L)),nt,lt,gt,Ut=P,Kt=O(g.width*Pe),zt=!1,ge=null,fe=null,re=null,Ze=null;u!=null&&(Kt==0||d!=null)&&(zt=!0,ge=u.values(f,m,y,p),fe=new Map,new Set(ge).forEach(Pt=>{Pt!=null&&fe.set(Pt,new Path2D)}),Kt>0&&(re=d.values(f,m,y,p),Ze=new Map,new Set(re).forEach(Pt=>{Pt!=null&&Ze.set(Pt,new Path2D)})));let{x0:He,size:pn}=c;if(He!=null&&pn!=null){k=1,_=He.values(f,m,y,p),He.unit==2&&(_=_.map(ae=>f.posToVal(M+ae*P,v.key,!0)));let Pt=pn.values(f,m,y,p);pn.unit==2?lt=Pt[0]*P:lt=S(Pt[0],v,P,M)-S(0,v,P,M),Ut=k0(_,w,S,v,P,M,Ut),gt=Ut-lt+N}else Ut=k0(_,w,S,v,P,M,Ut),gt=Ut*o+N,lt=Ut-gt;gt<1&&(gt=0),Kt>=lt/2&&(Kt=0),gt<5&&(O=Y0);let Ue=gt>0,Ln=Ut-gt-(Ue?Kt:0);lt=O(Df(Ln,z,W)),nt=(k==0?lt/2:k==Y?0:lt)-k*Y*((k==0?N/2:0)+(Ue?Kt/2:0));let Me={stroke:null,fill:null,clip:null,band:null,gaps:null,flags:0},Mn=zt?null:new Path2D,rn=null;if(ht!=null)rn=f.data[ht.series[1]];else{let{y0:Pt,y1:Zt}=c;Pt!=null&&Zt!=null&&(w=Zt.values(f,m,y,p),rn=Pt.values(f,m,y,p))}let mn=H*lt,G=it*lt;for(let Pt=Y==1?y:p;Pt>=y&&Pt<=p;Pt+=Y){let Zt=w[Pt];if(Zt==null)continue;if(rn!=null){let $=rn[Pt]??0;if(Zt-$==0)continue;rt=x($,A,R,L)}let ae=v.distr!=2||c!=null?_[Pt]:Pt,wt=S(ae,v,P,M),ke=x(Ce(Zt,j),A,R,L),Wt=O(wt-nt),Jt=O(di(ke,rt)),I=O(is(ke,rt)),T=Jt-I;if(Zt!=null){let $=Zt<0?G:mn,mt=Zt<0?mn:G;zt?(Kt>0&&re[Pt]!=null&&K(Ze.get(re[Pt]),Wt,I+Li(Kt/2),lt,di(0,T-Kt),$,mt),ge[Pt]!=null&&K(fe.get(ge[Pt]),Wt,I+Li(Kt/2),lt,di(0,T-Kt),$,mt)):K(Mn,Wt,I+Li(Kt/2),lt,di(0,T-Kt),$,mt),tt(f,m,Pt,Wt-Kt/2,I,lt+Kt,T)}}return Kt>0?Me.stroke=zt?Ze:Mn:zt||(Me._fill=g.width==0?g._fill:g._stroke??g._fill,Me.width=0),Me.fill=zt?fe:Mn,Me})}function mw(s,t){let e=Ce(t?.alignGaps,0);return(n,i,r,o)=>Jr(n,i,(a,l,c,h,u,d,f,m,y,p,g)=>{[r,o]=Yc(c,r,o);let _=a.pxRound,w=H=>_(d(H,h,p,m)),v=H=>_(f(H,u,g,y)),A,S,x;h.ori==0?(A=Qc,x=Ho,S=by):(A=th,x=Wo,S=Sy);let M=h.dir*(h.ori==0?1:-1),L=w(l[M==1?r:o]),P=L,R=[],O=[];for(let H=M==1?r:o;H>=r&&H<=o;H+=M)if(c[H]!=null){let Y=l[H],K=w(Y);R.push(P=K),O.push(v(c[H]))}let k={stroke:s(R,O,A,x,S,_),fill:null,clip:null,band:null,gaps:null,flags:Vo},N=k.stroke,[W,z]=Kf(n,i);if(a.fill!=null||W!=0){let H=k.fill=new Path2D(N),it=a.fillTo(n,i,a.min,a.max,W),Y=v(it);x(H,P,Y),x(H,L,Y)}if(!a.spanGaps){let H=[];H.push(...Zf(l,c,r,o,M,w,e)),k.gaps=H=a.gaps(n,i,r,o,H),k.clip=Zc(H,h.ori,m,y,p,g)}return z!=0&&(k.band=z==2?[Vs(n,i,r,o,N,-1),Vs(n,i,r,o,N,1)]:Vs(n,i,r,o,N,z)),k})}function gw(s){return mw(yw,s)}function yw(s,t,e,n,i,r){let o=s.length;if(o<2)return null;let a=new Path2D;if(e(a,s[0],t[0]),o==2)n(a,s[1],t[1]);else{let l=Array(o),c=Array(o-1),h=Array(o-1),u=Array(o-1);for(let d=0;d<o-1;d++)h[d]=t[d+1]-t[d],u[d]=s[d+1]-s[d],c[d]=h[d]/u[d];l[0]=c[0];for(let d=1;d<o-1;d++)c[d]===0||c[d-1]===0||c[d-1]>0!=c[d]>0?l[d]=0:(l[d]=3*(u[d-1]+u[d])/((2*u[d]+u[d-1])/c[d-1]+(u[d]+2*u[d-1])/c[d]),isFinite(l[d])||(l[d]=0));l[o-1]=c[o-2];for(let d=0;d<o-1;d++)i(a,s[d]+u[d]/3,t[d]+l[d]*u[d]/3,s[d+1]-u[d]/3,t[d+1]-l[d+1]*u[d]/3,s[d+1],t[d+1])}return a}var Bf=new Set;function z0(){for(let s of Bf)s.syncRect(!0)}Go&&(Yr(KS,Uo,z0),Yr(ZS,Uo,z0,!0),Yr(Xc,Uo,()=>{Fn.pxRatio=Pe}));var _w=Ty(),xw=My();function V0(s,t,e,n){return(n?[s[0],s[1]].concat(s.slice(2)):[s[0]].concat(s.slice(1))).map((r,o)=>kf(r,o,t,e))}function vw(s,t){return s.map((e,n)=>n==0?{}:vn({},t,e))}function kf(s,t,e,n){return vn({},t==0?e:n,s)}function Ay(s,t,e){return t==null?ko:[t,e]}var bw=Ay;function Sw(s,t,e){return t==null?ko:qc(t,e,Wf,!0)}function Ey(s,t,e,n){return t==null?ko:$c(t,e,s.scales[n].log,!1)}var Mw=Ey;function Cy(s,t,e,n){return t==null?ko:Hf(t,e,s.scales[n].log,!1)}var ww=Cy;function Tw(s,t,e,n,i){let r=di(x0(s),x0(t)),o=t-s,a=ns(i/n*o,e);do{let l=e[a],c=n*l/o;if(c>=i&&r+(l<5?_r.get(l):0)<=17)return[l,c]}while(++a<e.length);return[0,0]}function G0(s){let t,e;return s=s.replace(/(\d+)px/,(n,i)=>(t=An((e=+i)*Pe))+"px"),[s,t,e]}function Aw(s){s.show&&[s.font,s.labelFont].forEach(t=>{let e=Ve(t[2]*Pe,1);t[0]=t[0].replace(/[0-9.]+px/,e+"px"),t[1]=e})}function Fn(s,t,e){let n={mode:Ce(s.mode,1)},i=n.mode;function r(b,E,D,U){let q=E.valToPct(b);return U+D*(E.dir==-1?1-q:q)}function o(b,E,D,U){let q=E.valToPct(b);return U+D*(E.dir==-1?q:1-q)}function a(b,E,D,U){return E.ori==0?r(b,E,D,U):o(b,E,D,U)}n.valToPosH=r,n.valToPosV=o;let l=!1;n.status=0;let c=n.root=Hi(NS);if(s.id!=null&&(c.id=s.id),Pi(c,s.class),s.title){let b=Hi(FS,c);b.textContent=s.title}let h=es("canvas"),u=n.ctx=h.getContext("2d"),d=Hi(US,c);Yr("click",d,b=>{b.target===m&&(qe!=Po||Qe!=Lo)&&Gn.click(n,b)},!0);let f=n.under=Hi(BS,d);d.appendChild(h);let m=n.over=Hi(kS,d);s=zo(s);let y=+Ce(s.pxAlign,1),p=B0(y);(s.plugins||[]).forEach(b=>{b.opts&&(s=b.opts(n,s)||s)});let g=s.ms||.001,_=n.series=i==1?V0(s.series||[],L0,F0,!1):vw(s.series||[null],O0),w=n.axes=V0(s.axes||[],P0,N0,!0),v=n.scales={},A=n.bands=s.bands||[];A.forEach(b=>{b.fill=be(b.fill||null),b.dir=Ce(b.dir,-1)});let S=i==2?_[1].facets[0].scale:_[0].scale,x={axes:Us,series:_e},M=(s.drawOrder||["axes","series"]).map(b=>x[b]);function L(b){let E=b.distr==3?D=>zs(D>0?D:b.clamp(n,D,b.min,b.max,b.key)):b.distr==4?D=>Af(D,b.asinh):b.distr==100?D=>b.fwd(D):D=>D;return D=>{let U=E(D),{_min:q,_max:Q}=b,ft=Q-q;return(U-q)/ft}}function P(b){let E=v[b];if(E==null){let D=(s.scales||nl)[b]||nl;if(D.from!=null){P(D.from);let U=vn({},v[D.from],D,{key:b});U.valToPct=L(U),v[b]=U}else{E=v[b]=vn({},b==S?gy:lw,D),E.key=b;let U=E.time,q=E.range,Q=yr(q);if((b!=S||i==2&&!U)&&(Q&&(q[0]==null||q[1]==null)&&(q={min:q[0]==null?g0:{mode:1,hard:q[0],soft:q[0]},max:q[1]==null?g0:{mode:1,hard:q[1],soft:q[1]}},Q=!1),!Q&&Kc(q))){let ft=q;q=(yt,St,Ot)=>St==null?ko:qc(St,Ot,ft)}E.range=be(q||(U?bw:b==S?E.distr==3?Mw:E.distr==4?ww:Ay:E.distr==3?Ey:E.distr==4?Cy:Sw)),E.auto=be(Q?!1:E.auto),E.clamp=be(E.clamp||aw),E._min=E._max=null,E.valToPct=L(E)}}}P("x"),P("y"),i==1&&_.forEach(b=>{P(b.scale)}),w.forEach(b=>{P(b.scale)});for(let b in s.scales)P(b);let R=v[S],O=R.distr,k,N;R.ori==0?(Pi(c,DS),k=r,N=o):(Pi(c,OS),k=o,N=r);let W={};for(let b in v){let E=v[b];(E.min!=null||E.max!=null)&&(W[b]={min:E.min,max:E.max},E.min=E.max=null)}let z=s.tzDate||(b=>new Date(An(b/g))),H=s.fmtDate||jf,it=g==1?DM(z):UM(z),Y=E0(z,A0(g==1?NM:FM,H)),K=R0(z,C0(kM,H)),tt=[],ht=n.legend=vn({},GM,s.legend),st=n.cursor=vn({},YM,{drag:{y:i==2}},s.cursor),j=ht.show,rt=st.show,nt=ht.markers;ht.idxs=tt,nt.width=be(nt.width),nt.dash=be(nt.dash),nt.stroke=be(nt.stroke),nt.fill=be(nt.fill);let lt,gt,Ut,Kt=[],zt=[],ge,fe=!1,re={};if(ht.live){let b=_[1]?_[1].values:null;fe=b!=null,ge=fe?b(n,1,0):{_:0};for(let E in ge)re[E]=Vf}if(j)if(lt=es("table",XS,c),Ut=es("tbody",null,lt),ht.mount(n,lt),fe){gt=es("thead",null,lt,Ut);let b=es("tr",null,gt);es("th",null,b);for(var Ze in ge)es("th",i0,b).textContent=Ze}else Pi(lt,jS),ht.live&&Pi(lt,qS);let He={show:!0},pn={show:!1};function Ue(b,E){if(E==0&&(fe||!ht.live||i==2))return ko;let D=[],U=es("tr",YS,Ut,Ut.childNodes[E]);Pi(U,b.class),b.show||Pi(U,jr);let q=es("th",null,U);if(nt.show){let yt=Hi($S,q);if(E>0){let St=nt.width(n,E);St&&(yt.style.border=St+"px "+nt.dash(n,E)+" "+nt.stroke(n,E)),yt.style.background=nt.fill(n,E)}}let Q=Hi(i0,q);b.label instanceof HTMLElement?Q.appendChild(b.label):Q.textContent=b.label,E>0&&(nt.show||(Q.style.color=b.width>0?nt.stroke(n,E):nt.fill(n,E)),Me("click",q,yt=>{if(st._lock)return;ee(yt);let St=_.indexOf(b);if((yt.ctrlKey||yt.metaKey)!=ht.isolate){let Ot=_.some((Ft,kt)=>kt>0&&kt!=St&&Ft.show);_.forEach((Ft,kt)=>{kt>0&&gs(kt,Ot?kt==St?He:pn:He,!0,xn.setSeries)})}else gs(St,{show:!b.show},!0,xn.setSeries)},!1),ne&&Me(a0,q,yt=>{st._lock||(ee(yt),gs(_.indexOf(b),No,!0,xn.setSeries))},!1));for(var ft in ge){let yt=es("td",JS,U);yt.textContent="--",D.push(yt)}return[U,D]}let Ln=new Map;function Me(b,E,D,U=!0){let q=Ln.get(E)||{},Q=st.bind[b](n,E,D,U);Q&&(Yr(b,E,q[b]=Q),Ln.set(E,q))}function Mn(b,E,D){let U=Ln.get(E)||{};for(let q in U)(b==null||q==b)&&(Nf(q,E,U[q]),delete U[q]);b==null&&Ln.delete(E)}let rn=0,mn=0,G=0,Pt=0,Zt=0,ae=0,wt=Zt,ke=ae,Wt=G,Jt=Pt,I=0,T=0,$=0,mt=0;n.bbox={};let dt=!1,vt=!1,bt=!1,ot=!1,ct=!1,_t=!1;function V(b,E,D){(D||b!=n.width||E!=n.height)&&ut(b,E),pe(!1),bt=!0,vt=!0,Zn()}function ut(b,E){n.width=rn=G=b,n.height=mn=Pt=E,Zt=ae=0,Mt(),qt();let D=n.bbox;I=D.left=Xr(Zt*Pe,.5),T=D.top=Xr(ae*Pe,.5),$=D.width=Xr(G*Pe,.5),mt=D.height=Xr(Pt*Pe,.5)}let at=3;function Tt(){let b=!1,E=0;for(;!b;){E++;let D=Eo(E),U=ms(E);b=E==at||D&&U,b||(ut(n.width,n.height),vt=!0)}}function xt({width:b,height:E}){V(b,E)}n.setSize=xt;function Mt(){let b=!1,E=!1,D=!1,U=!1;w.forEach((q,Q)=>{if(q.show&&q._show){let{side:ft,_size:yt}=q,St=ft%2,Ot=q.label!=null?q.labelSize:0,Ft=yt+Ot;Ft>0&&(St?(G-=Ft,ft==3?(Zt+=Ft,U=!0):D=!0):(Pt-=Ft,ft==0?(ae+=Ft,b=!0):E=!0))}}),fs[0]=b,fs[1]=D,fs[2]=E,fs[3]=U,G-=Zi[1]+Zi[3],Zt+=Zi[3],Pt-=Zi[2]+Zi[0],ae+=Zi[0]}function qt(){let b=Zt+G,E=ae+Pt,D=Zt,U=ae;function q(Q,ft){switch(Q){case 1:return b+=ft,b-ft;case 2:return E+=ft,E-ft;case 3:return D-=ft,D+ft;case 0:return U-=ft,U+ft}}w.forEach((Q,ft)=>{if(Q.show&&Q._show){let yt=Q.side;Q._pos=q(yt,Q._size),Q.label!=null&&(Q._lpos=q(yt,Q.labelSize))}})}if(st.dataIdx==null){let b=st.hover,E=b.skip=new Set(b.skip??[]);E.add(void 0);let D=b.prox=be(b.prox),U=b.bias??=0;st.dataIdx=(q,Q,ft,yt)=>{if(Q==0)return ft;let St=ft,Ot=D(q,Q,ft,yt)??ze,Ft=Ot>=0&&Ot<ze,kt=R.ori==0?G:Pt,oe=st.left,Re=t[0],Ee=t[Q];if(E.has(Ee[ft])){St=null;let xe=null,Qt=null,jt;if(U==0||U==-1)for(jt=ft;xe==null&&jt-- >0;)E.has(Ee[jt])||(xe=jt);if(U==0||U==1)for(jt=ft;Qt==null&&jt++<Ee.length;)E.has(Ee[jt])||(Qt=jt);if(xe!=null||Qt!=null)if(Ft){let Ye=xe==null?-1/0:k(Re[xe],R,kt,0),ln=Qt==null?1/0:k(Re[Qt],R,kt,0),On=oe-Ye,Be=ln-oe;On<=Be?On<=Ot&&(St=xe):Be<=Ot&&(St=Qt)}else St=Qt==null?xe:xe==null?Qt:ft-xe<=Qt-ft?xe:Qt}else Ft&&En(oe-k(Re[ft],R,kt,0))>Ot&&(St=null);return St}}let ee=b=>{st.event=b};st.idxs=tt,st._lock=!1;let pt=st.points;pt.show=be(pt.show),pt.size=be(pt.size),pt.stroke=be(pt.stroke),pt.width=be(pt.width),pt.fill=be(pt.fill);let Vt=n.focus=vn({},s.focus||{alpha:.3},st.focus),ne=Vt.prox>=0,Ct=ne&&pt.one,ce=[],Xe=[],oi=[];function ka(b,E){let D=pt.show(n,E);if(D instanceof HTMLElement)return Pi(D,WS),Pi(D,b.class),vs(D,-10,-10,G,Pt),m.insertBefore(D,ce[E]),D}function wo(b,E){if(i==1||E>0){let D=i==1&&v[b.scale].time,U=b.value;b.value=D?S0(U)?R0(z,C0(U,H)):U||K:U||sw,b.label=b.label||(D?JM:$M)}if(Ct||E>0){b.width=b.width==null?1:b.width,b.paths=b.paths||_w||lM,b.fillTo=be(b.fillTo||cw),b.pxAlign=+Ce(b.pxAlign,y),b.pxRound=B0(b.pxAlign),b.stroke=be(b.stroke||null),b.fill=be(b.fill||null),b._stroke=b._fill=b._paths=b._focus=null;let D=rw(di(1,b.width),1),U=b.points=vn({},{size:D,width:di(1,D*.2),stroke:b.stroke,space:D*2,paths:xw,_stroke:null,_fill:null},b.points);U.show=be(U.show),U.filter=be(U.filter),U.fill=be(U.fill),U.stroke=be(U.stroke),U.paths=be(U.paths),U.pxAlign=b.pxAlign}if(j){let D=Ue(b,E);Kt.splice(E,0,D[0]),zt.splice(E,0,D[1]),ht.values.push(null)}if(rt){tt.splice(E,0,null);let D=null;Ct?E==0&&(D=ka(b,E)):E>0&&(D=ka(b,E)),ce.splice(E,0,D),Xe.splice(E,0,0),oi.splice(E,0,0)}Dn("addSeries",E)}function rf(b,E){E=E??_.length,b=i==1?kf(b,E,L0,F0):kf(b,E,{},O0),_.splice(E,0,b),wo(_[E],E)}n.addSeries=rf;function yc(b){if(_.splice(b,1),j){ht.values.splice(b,1),zt.splice(b,1);let E=Kt.splice(b,1)[0];Mn(null,E.firstChild),E.remove()}rt&&(tt.splice(b,1),ce.splice(b,1)[0].remove(),Xe.splice(b,1),oi.splice(b,1)),Dn("delSeries",b)}n.delSeries=yc;let fs=[!1,!1,!1,!1];function Ds(b,E){if(b._show=b.show,b.show){let D=b.side%2,U=v[b.scale];U==null&&(b.scale=D?_[1].scale:S,U=v[b.scale]);let q=U.time;b.size=be(b.size),b.space=be(b.space),b.rotate=be(b.rotate),yr(b.incrs)&&b.incrs.forEach(ft=>{!_r.has(ft)&&_r.set(ft,K0(ft))}),b.incrs=be(b.incrs||(U.distr==2?PM:q?g==1?IM:OM:qr)),b.splits=be(b.splits||(q&&U.distr==1?it:U.distr==3?Of:U.distr==4?QM:ZM)),b.stroke=be(b.stroke),b.grid.stroke=be(b.grid.stroke),b.ticks.stroke=be(b.ticks.stroke),b.border.stroke=be(b.border.stroke);let Q=b.values;b.values=yr(Q)&&!yr(Q[0])?be(Q):q?yr(Q)?E0(z,A0(Q,H)):S0(Q)?BM(z,Q):Q||Y:Q||KM,b.filter=be(b.filter||(U.distr>=3&&U.log==10?nw:U.distr==3&&U.log==2?iw:$0)),b.font=G0(b.font),b.labelFont=G0(b.labelFont),b._size=b.size(n,null,E,0),b._space=b._rotate=b._incrs=b._found=b._splits=b._values=null,b._size>0&&(fs[E]=!0,b._el=Hi(zS,d))}}function Os(b,E,D,U){let[q,Q,ft,yt]=D,St=E%2,Ot=0;return St==0&&(yt||Q)&&(Ot=E==0&&!q||E==2&&!ft?An(P0.size/3):0),St==1&&(q||ft)&&(Ot=E==1&&!Q||E==3&&!yt?An(N0.size/2):0),Ot}let za=n.padding=(s.padding||[Os,Os,Os,Os]).map(b=>be(Ce(b,Os))),Zi=n._padding=za.map((b,E)=>b(n,E,fs,0)),on,un=null,dn=null,ps=i==1?_[0].idxs:null,Ti=null,hr=!1;function Va(b,E){if(t=b??[],n.data=n._data=t,i==2){on=0;for(let D=1;D<_.length;D++)on+=t[D][0].length}else{t.length==0&&(n.data=n._data=t=[[]]),Ti=t[0],on=Ti.length;let D=t;if(O==2){D=t.slice();let U=D[0]=Array(on);for(let q=0;q<on;q++)U[q]=q}n._data=t=D}if(pe(!0),Dn("setData"),O==2&&(bt=!0),E!==!1){let D=R;D.auto(n,hr)?Ga():fr(S,D.min,D.max),ot=ot||st.left>=0,_t=!0,Zn()}}n.setData=Va;function Ga(){hr=!0;let b,E;i==1&&(on>0?(un=ps[0]=0,dn=ps[1]=on-1,b=t[0][un],E=t[0][dn],O==2?(b=un,E=dn):b==E&&(O==3?[b,E]=$c(b,b,R.log,!1):O==4?[b,E]=Hf(b,b,R.log,!1):R.time?E=b+An(86400/g):[b,E]=qc(b,E,Wf,!0))):(un=ps[0]=b=null,dn=ps[1]=E=null)),fr(S,b,E)}let To,ur,Ao,C,X,et,J,Z,At,It;function Et(b,E,D,U,q,Q){b??=r0,D??=qf,U??="butt",q??=r0,Q??="round",b!=To&&(u.strokeStyle=To=b),q!=ur&&(u.fillStyle=ur=q),E!=Ao&&(u.lineWidth=Ao=E),Q!=X&&(u.lineJoin=X=Q),U!=et&&(u.lineCap=et=U),D!=C&&u.setLineDash(C=D)}function Dt(b,E,D,U){E!=ur&&(u.fillStyle=ur=E),b!=J&&(u.font=J=b),D!=Z&&(u.textAlign=Z=D),U!=At&&(u.textBaseline=At=U)}function Ht(b,E,D,U,q=0){if(U.length>0&&b.auto(n,hr)&&(E==null||E.min==null)){let Q=Ce(un,0),ft=Ce(dn,U.length-1),yt=D.min==null?nM(U,Q,ft,q,b.distr==3):[D.min,D.max];b.min=is(b.min,D.min=yt[0]),b.max=di(b.max,D.max=yt[1])}}let ie={min:null,max:null};function ye(){for(let U in v){let q=v[U];W[U]==null&&(q.min==null||W[S]!=null&&q.auto(n,hr))&&(W[U]=ie)}for(let U in v){let q=v[U];W[U]==null&&q.from!=null&&W[q.from]!=null&&(W[U]=ie)}W[S]!=null&&pe(!0);let b={};for(let U in W){let q=W[U];if(q!=null){let Q=b[U]=zo(v[U],uM);if(q.min!=null)vn(Q,q);else if(U!=S||i==2)if(on==0&&Q.from==null){let ft=Q.range(n,null,null,U);Q.min=ft[0],Q.max=ft[1]}else Q.min=ze,Q.max=-ze}}if(on>0){_.forEach((U,q)=>{if(i==1){let Q=U.scale,ft=W[Q];if(ft==null)return;let yt=b[Q];if(q==0){let St=yt.range(n,yt.min,yt.max,Q);yt.min=St[0],yt.max=St[1],un=ns(yt.min,t[0]),dn=ns(yt.max,t[0]),dn-un>1&&(t[0][un]<yt.min&&un++,t[0][dn]>yt.max&&dn--),U.min=Ti[un],U.max=Ti[dn]}else U.show&&U.auto&&Ht(yt,ft,U,t[q],U.sorted);U.idxs[0]=un,U.idxs[1]=dn}else if(q>0&&U.show&&U.auto){let[Q,ft]=U.facets,yt=Q.scale,St=ft.scale,[Ot,Ft]=t[q],kt=b[yt],oe=b[St];kt!=null&&Ht(kt,W[yt],Q,Ot,Q.sorted),oe!=null&&Ht(oe,W[St],ft,Ft,ft.sorted),U.min=ft.min,U.max=ft.max}});for(let U in b){let q=b[U],Q=W[U];if(q.from==null&&(Q==null||Q.min==null)){let ft=q.range(n,q.min==ze?null:q.min,q.max==-ze?null:q.max,U);q.min=ft[0],q.max=ft[1]}}}for(let U in b){let q=b[U];if(q.from!=null){let Q=b[q.from];if(Q.min==null)q.min=q.max=null;else{let ft=q.range(n,Q.min,Q.max,U);q.min=ft[0],q.max=ft[1]}}}let E={},D=!1;for(let U in b){let q=b[U],Q=v[U];if(Q.min!=q.min||Q.max!=q.max){Q.min=q.min,Q.max=q.max;let ft=Q.distr;Q._min=ft==3?zs(Q.min):ft==4?Af(Q.min,Q.asinh):ft==100?Q.fwd(Q.min):Q.min,Q._max=ft==3?zs(Q.max):ft==4?Af(Q.max,Q.asinh):ft==100?Q.fwd(Q.max):Q.max,E[U]=D=!0}}if(D){_.forEach((U,q)=>{i==2?q>0&&E.y&&(U._paths=null):E[U.scale]&&(U._paths=null)});for(let U in E)bt=!0,Dn("setScale",U);rt&&st.left>=0&&(ot=_t=!0)}for(let U in W)W[U]=null}function Gt(b){let E=Df(un-1,0,on-1),D=Df(dn+1,0,on-1);for(;b[E]==null&&E>0;)E--;for(;b[D]==null&&D<on-1;)D++;return[E,D]}function _e(){if(on>0){let b=_.some(E=>E._focus)&&It!=Vt.alpha;b&&(u.globalAlpha=It=Vt.alpha),_.forEach((E,D)=>{if(D>0&&E.show&&(en(D,!1),en(D,!0),E._paths==null)){let U=It;It!=E.alpha&&(u.globalAlpha=It=E.alpha);let q=i==2?[0,t[D][0].length-1]:Gt(t[D]);E._paths=E.paths(n,D,q[0],q[1]),It!=U&&(u.globalAlpha=It=U)}}),_.forEach((E,D)=>{if(D>0&&E.show){let U=It;It!=E.alpha&&(u.globalAlpha=It=E.alpha),E._paths!=null&&De(D,!1);{let q=E._paths!=null?E._paths.gaps:null,Q=E.points.show(n,D,un,dn,q),ft=E.points.filter(n,D,Q,q);(Q||ft)&&(E.points._paths=E.points.paths(n,D,un,dn,ft),De(D,!0))}It!=U&&(u.globalAlpha=It=U),Dn("drawSeries",D)}}),b&&(u.globalAlpha=It=1)}}function en(b,E){let D=E?_[b].points:_[b];D._stroke=D.stroke(n,b),D._fill=D.fill(n,b)}function De(b,E){let D=E?_[b].points:_[b],{stroke:U,fill:q,clip:Q,flags:ft,_stroke:yt=D._stroke,_fill:St=D._fill,_width:Ot=D.width}=D._paths;Ot=Ve(Ot*Pe,3);let Ft=null,kt=Ot%2/2;E&&St==null&&(St=Ot>0?"#fff":yt);let oe=D.pxAlign==1&&kt>0;if(oe&&u.translate(kt,kt),!E){let Re=I-Ot/2,Ee=T-Ot/2,xe=$+Ot,Qt=mt+Ot;Ft=new Path2D,Ft.rect(Re,Ee,xe,Qt)}E?Bt(yt,Ot,D.dash,D.cap,St,U,q,ft,Q):Oe(b,yt,Ot,D.dash,D.cap,St,U,q,ft,Ft,Q),oe&&u.translate(-kt,-kt)}function Oe(b,E,D,U,q,Q,ft,yt,St,Ot,Ft){let kt=!1;St!=0&&A.forEach((oe,Re)=>{if(oe.series[0]==b){let Ee=_[oe.series[1]],xe=t[oe.series[1]],Qt=(Ee._paths||nl).band;yr(Qt)&&(Qt=oe.dir==1?Qt[0]:Qt[1]);let jt,Ye=null;Ee.show&&Qt&&sM(xe,un,dn)?(Ye=oe.fill(n,Re)||Q,jt=Ee._paths.clip):Qt=null,Bt(E,D,U,q,Ye,ft,yt,St,Ot,Ft,jt,Qt),kt=!0}}),kt||Bt(E,D,U,q,Q,ft,yt,St,Ot,Ft)}let wn=Vo|Uf;function Bt(b,E,D,U,q,Q,ft,yt,St,Ot,Ft,kt){Et(b,E,D,U,q),(St||Ot||kt)&&(u.save(),St&&u.clip(St),Ot&&u.clip(Ot)),kt?(yt&wn)==wn?(u.clip(kt),Ft&&u.clip(Ft),ve(q,ft),gn(b,Q,E)):yt&Uf?(ve(q,ft),u.clip(kt),gn(b,Q,E)):yt&Vo&&(u.save(),u.clip(kt),Ft&&u.clip(Ft),ve(q,ft),u.restore(),gn(b,Q,E)):(ve(q,ft),gn(b,Q,E)),(St||Ot||kt)&&u.restore()}function gn(b,E,D){D>0&&(E instanceof Map?E.forEach((U,q)=>{u.strokeStyle=To=q,u.stroke(U)}):E!=null&&b&&u.stroke(E))}function ve(b,E){E instanceof Map?E.forEach((D,U)=>{u.fillStyle=ur=U,u.fill(D)}):E!=null&&b&&u.fill(E)}function Fs(b,E,D,U){let q=w[b],Q;if(U<=0)Q=[0,0];else{let ft=q._space=q.space(n,b,E,D,U),yt=q._incrs=q.incrs(n,b,E,D,U,ft);Q=Tw(E,D,yt,U,ft)}return q._found=Q}function yn(b,E,D,U,q,Q,ft,yt,St,Ot){let Ft=ft%2/2;y==1&&u.translate(Ft,Ft),Et(yt,ft,St,Ot,yt),u.beginPath();let kt,oe,Re,Ee,xe=q+(U==0||U==3?-Q:Q);D==0?(oe=q,Ee=xe):(kt=q,Re=xe);for(let Qt=0;Qt<b.length;Qt++)E[Qt]!=null&&(D==0?kt=Re=b[Qt]:oe=Ee=b[Qt],u.moveTo(kt,oe),u.lineTo(Re,Ee));u.stroke(),y==1&&u.translate(-Ft,-Ft)}function Eo(b){let E=!0;return w.forEach((D,U)=>{if(!D.show)return;let q=v[D.scale];if(q.min==null){D._show&&(E=!1,D._show=!1,pe(!1));return}else D._show||(E=!1,D._show=!0,pe(!1));let Q=D.side,ft=Q%2,{min:yt,max:St}=q,[Ot,Ft]=Fs(U,yt,St,ft==0?G:Pt);if(Ft==0)return;let kt=q.distr==2,oe=D._splits=D.splits(n,U,yt,St,Ot,Ft,kt),Re=q.distr==2?oe.map(jt=>Ti[jt]):oe,Ee=q.distr==2?Ti[oe[1]]-Ti[oe[0]]:Ot,xe=D._values=D.values(n,D.filter(n,Re,U,Ft,Ee),U,Ft,Ee);D._rotate=Q==2?D.rotate(n,xe,U,Ft):0;let Qt=D._size;D._size=Wi(D.size(n,xe,U,b)),Qt!=null&&D._size!=Qt&&(E=!1)}),E}function ms(b){let E=!0;return za.forEach((D,U)=>{let q=D(n,U,fs,b);q!=Zi[U]&&(E=!1),Zi[U]=q}),E}function Us(){for(let b=0;b<w.length;b++){let E=w[b];if(!E.show||!E._show)continue;let D=E.side,U=D%2,q,Q,ft=E.stroke(n,b),yt=D==0||D==3?-1:1,[St,Ot]=E._found;if(E.label!=null){let ci=E.labelGap*yt,Ci=An((E._lpos+ci)*Pe);Dt(E.labelFont[0],ft,"center",D==2?"top":s0),u.save(),U==1?(q=Q=0,u.translate(Ci,An(T+mt/2)),u.rotate((D==3?-Wc:Wc)/2)):(q=An(I+$/2),Q=Ci);let zr=j0(E.label)?E.label(n,b,St,Ot):E.label;u.fillText(zr,q,Q),u.restore()}if(Ot==0)continue;let Ft=v[E.scale],kt=U==0?$:mt,oe=U==0?I:T,Re=E._splits,Ee=Ft.distr==2?Re.map(ci=>Ti[ci]):Re,xe=Ft.distr==2?Ti[Re[1]]-Ti[Re[0]]:St,Qt=E.ticks,jt=E.border,Ye=Qt.show?Qt.size:0,ln=An(Ye*Pe),On=An((E.alignTo==2?E._size-Ye-E.gap:E.gap)*Pe),Be=E._rotate*-Wc/180,cn=p(E._pos*Pe),Ai=(ln+On)*yt,li=cn+Ai;Q=U==0?li:0,q=U==1?li:0;let Vi=E.font[0],Qi=E.align==1?Oo:E.align==2?Mf:Be>0?Oo:Be<0?Mf:U==0?"center":D==3?Mf:Oo,_s=Be||U==1?"middle":D==2?"top":s0;Dt(Vi,ft,Qi,_s);let Ei=E.font[1]*E.lineGap,Gi=Re.map(ci=>p(a(ci,Ft,kt,oe))),ts=E._values;for(let ci=0;ci<ts.length;ci++){let Ci=ts[ci];if(Ci!=null){U==0?q=Gi[ci]:Q=Gi[ci],Ci=""+Ci;let zr=Ci.indexOf(`
`)==-1?[Ci]:Ci.split(/\n/gm);for(let hi=0;hi<zr.length;hi++){let yg=zr[hi];Be?(u.save(),u.translate(q,Q+hi*Ei),u.rotate(Be),u.fillText(yg,0,0),u.restore()):u.fillText(yg,q,Q+hi*Ei)}}}Qt.show&&yn(Gi,Qt.filter(n,Ee,b,Ot,xe),U,D,cn,ln,Ve(Qt.width*Pe,3),Qt.stroke(n,b),Qt.dash,Qt.cap);let xs=E.grid;xs.show&&yn(Gi,xs.filter(n,Ee,b,Ot,xe),U,U==0?2:1,U==0?T:I,U==0?mt:$,Ve(xs.width*Pe,3),xs.stroke(n,b),xs.dash,xs.cap),jt.show&&yn([cn],[1],U==0?1:0,U==0?1:2,U==1?T:I,U==1?mt:$,Ve(jt.width*Pe,3),jt.stroke(n,b),jt.dash,jt.cap)}Dn("drawAxes")}function pe(b){_.forEach((E,D)=>{D>0&&(E._paths=null,b&&(i==1?(E.min=null,E.max=null):E.facets.forEach(U=>{U.min=null,U.max=null})))})}let an=!1,ai=!1,Fe=[];function _n(){ai=!1;for(let b=0;b<Fe.length;b++)Dn(...Fe[b]);Fe.length=0}function Zn(){an||(_M(Qm),an=!0)}function _c(b,E=!1){an=!0,ai=E,b(n),Qm(),E&&Fe.length>0&&queueMicrotask(_n)}n.batch=_c;function Qm(){if(dt&&(ye(),dt=!1),bt&&(Tt(),bt=!1),vt){if(Je(f,Oo,Zt),Je(f,"top",ae),Je(f,Za,G),Je(f,Qa,Pt),Je(m,Oo,Zt),Je(m,"top",ae),Je(m,Za,G),Je(m,Qa,Pt),Je(d,Za,rn),Je(d,Qa,mn),h.width=An(rn*Pe),h.height=An(mn*Pe),w.forEach(({_el:b,_show:E,_size:D,_pos:U,side:q})=>{if(b!=null)if(E){let Q=q===3||q===0?D:0,ft=q%2==1;Je(b,ft?"left":"top",U-Q),Je(b,ft?"width":"height",D),Je(b,ft?"top":"left",ft?ae:Zt),Je(b,ft?"height":"width",ft?Pt:G),If(b,jr)}else Pi(b,jr)}),To=ur=Ao=X=et=J=Z=At=C=null,It=1,Xa(!0),Zt!=wt||ae!=ke||G!=Wt||Pt!=Jt){pe(!1);let b=G/Wt,E=Pt/Jt;if(rt&&!ot&&st.left>=0){st.left*=b,st.top*=E,Co&&vs(Co,An(st.left),0,G,Pt),Ro&&vs(Ro,0,An(st.top),G,Pt);for(let D=0;D<ce.length;D++){let U=ce[D];U!=null&&(Xe[D]*=b,oi[D]*=E,vs(U,Wi(Xe[D]),Wi(oi[D]),G,Pt))}}if(je.show&&!ct&&je.left>=0&&je.width>0){je.left*=b,je.width*=b,je.top*=E,je.height*=E;for(let D in uf)Je(Io,D,je[D])}wt=Zt,ke=ae,Wt=G,Jt=Pt}Dn("setSize"),vt=!1}rn>0&&mn>0&&(u.clearRect(0,0,h.width,h.height),Dn("drawClear"),M.forEach(b=>b()),Dn("draw")),je.show&&ct&&(xc(je),ct=!1),rt&&ot&&(kr(null,!0,!1),ot=!1),ht.show&&ht.live&&_t&&(cf(),_t=!1),l||(l=!0,n.status=1,Dn("ready")),hr=!1,an=!1}n.redraw=(b,E)=>{bt=E||!1,b!==!1?fr(S,R.min,R.max):Zn()};function of(b,E){let D=v[b];if(D.from==null){if(on==0){let U=D.range(n,E.min,E.max,b);E.min=U[0],E.max=U[1]}if(E.min>E.max){let U=E.min;E.min=E.max,E.max=U}if(on>1&&E.min!=null&&E.max!=null&&E.max-E.min<1e-16)return;b==S&&D.distr==2&&on>0&&(E.min=ns(E.min,t[0]),E.max=ns(E.max,t[0]),E.min==E.max&&E.max++),W[b]=E,dt=!0,Zn()}}n.setScale=of;let af,lf,Co,Ro,tg,eg,Po,Lo,ng,ig,qe,Qe,dr=!1,Gn=st.drag,In=Gn.x,Nn=Gn.y;rt&&(st.x&&(af=Hi(GS,m)),st.y&&(lf=Hi(HS,m)),R.ori==0?(Co=af,Ro=lf):(Co=lf,Ro=af),qe=st.left,Qe=st.top);let je=n.select=vn({show:!0,over:!0,left:0,width:0,top:0,height:0},s.select),Io=je.show?Hi(VS,je.over?m:f):null;function xc(b,E){if(je.show){for(let D in b)je[D]=b[D],D in uf&&Je(Io,D,b[D]);E!==!1&&Dn("setSelect")}}n.setSelect=xc;function Mb(b){if(_[b].show)j&&If(Kt[b],jr);else if(j&&Pi(Kt[b],jr),rt){let D=Ct?ce[0]:ce[b];D!=null&&vs(D,-10,-10,G,Pt)}}function fr(b,E,D){of(b,{min:E,max:D})}function gs(b,E,D,U){E.focus!=null&&Cb(b),E.show!=null&&_.forEach((q,Q)=>{Q>0&&(b==Q||b==null)&&(q.show=E.show,Mb(Q),i==2?(fr(q.facets[0].scale,null,null),fr(q.facets[1].scale,null,null)):fr(q.scale,null,null),Zn())}),D!==!1&&Dn("setSeries",b,E),U&&qa("setSeries",n,b,E)}n.setSeries=gs;function wb(b,E){vn(A[b],E)}function Tb(b,E){b.fill=be(b.fill||null),b.dir=Ce(b.dir,-1),E=E??A.length,A.splice(E,0,b)}function Ab(b){b==null?A.length=0:A.splice(b,1)}n.addBand=Tb,n.setBand=wb,n.delBand=Ab;function Eb(b,E){_[b].alpha=E,rt&&ce[b]!=null&&(ce[b].style.opacity=E),j&&Kt[b]&&(Kt[b].style.opacity=E)}let Bs,pr,Br,No={focus:!0};function Cb(b){if(b!=Br){let E=b==null,D=Vt.alpha!=1;_.forEach((U,q)=>{if(i==1||q>0){let Q=E||q==0||q==b;U._focus=E?null:Q,D&&Eb(q,Q?1:Vt.alpha)}}),Br=b,D&&Zn()}}j&&ne&&Me(l0,lt,b=>{st._lock||(ee(b),Br!=null&&gs(null,No,!0,xn.setSeries))});function ys(b,E,D){let U=v[E];D&&(b=b/Pe-(U.ori==1?ae:Zt));let q=G;U.ori==1&&(q=Pt,b=q-b),U.dir==-1&&(b=q-b);let Q=U._min,ft=U._max,yt=b/q,St=Q+(ft-Q)*yt,Ot=U.distr;return Ot==3?Bo(10,St):Ot==4?oM(St,U.asinh):Ot==100?U.bwd(St):St}function Rb(b,E){let D=ys(b,S,E);return ns(D,t[0],un,dn)}n.valToIdx=b=>ns(b,t[0]),n.posToIdx=Rb,n.posToVal=ys,n.valToPos=(b,E,D)=>v[E].ori==0?r(b,v[E],D?$:G,D?I:0):o(b,v[E],D?mt:Pt,D?T:0),n.setCursor=(b,E,D)=>{qe=b.left,Qe=b.top,kr(null,E,D)};function sg(b,E){Je(Io,Oo,je.left=b),Je(Io,Za,je.width=E)}function rg(b,E){Je(Io,"top",je.top=b),Je(Io,Qa,je.height=E)}let Ha=R.ori==0?sg:rg,Wa=R.ori==1?sg:rg;function Pb(){if(j&&ht.live)for(let b=i==2?1:0;b<_.length;b++){if(b==0&&fe)continue;let E=ht.values[b],D=0;for(let U in E)zt[b][D++].firstChild.nodeValue=E[U]}}function cf(b,E){if(b!=null&&(b.idxs?b.idxs.forEach((D,U)=>{tt[U]=D}):hM(b.idx)||tt.fill(b.idx),ht.idx=tt[0]),j&&ht.live){for(let D=0;D<_.length;D++)(D>0||i==1&&!fe)&&Lb(D,tt[D]);Pb()}_t=!1,E!==!1&&Dn("setLegend")}n.setLegend=cf;function Lb(b,E){let D=_[b],U=b==0&&O==2?Ti:t[b],q;fe?q=D.values(n,b,E)??re:(q=D.value(n,E==null?null:U[E],b,E),q=q==null?re:{_:q}),ht.values[b]=q}function kr(b,E,D){ng=qe,ig=Qe,[qe,Qe]=st.move(n,qe,Qe),st.left=qe,st.top=Qe,rt&&(Co&&vs(Co,An(qe),0,G,Pt),Ro&&vs(Ro,0,An(Qe),G,Pt));let U,q=un>dn;Bs=ze,pr=null;let Q=R.ori==0?G:Pt,ft=R.ori==1?G:Pt;if(qe<0||on==0||q){U=st.idx=null;for(let yt=0;yt<_.length;yt++){let St=ce[yt];St!=null&&vs(St,-10,-10,G,Pt)}ne&&gs(null,No,!0,b==null&&xn.setSeries),ht.live&&(tt.fill(U),_t=!0)}else{let yt,St,Ot;i==1&&(yt=R.ori==0?qe:Qe,St=ys(yt,S),U=st.idx=ns(St,t[0],un,dn),Ot=k(t[0][U],R,Q,0));let Ft=-10,kt=-10,oe=0,Re=0,Ee=!0,xe="",Qt="";for(let jt=i==2?1:0;jt<_.length;jt++){let Ye=_[jt],ln=tt[jt],On=ln==null?null:i==1?t[jt][ln]:t[jt][1][ln],Be=st.dataIdx(n,jt,U,St),cn=Be==null?null:i==1?t[jt][Be]:t[jt][1][Be];if(_t=_t||cn!=On||Be!=ln,tt[jt]=Be,jt>0&&Ye.show){let Ai=Be==null?-10:Be==U?Ot:k(i==1?t[0][Be]:t[jt][0][Be],R,Q,0),li=cn==null?-10:N(cn,i==1?v[Ye.scale]:v[Ye.facets[1].scale],ft,0);if(ne&&cn!=null){let Vi=R.ori==1?qe:Qe,Qi=En(Vt.dist(n,jt,Be,li,Vi));if(Qi<Bs){let _s=Vt.bias;if(_s!=0){let Ei=ys(Vi,Ye.scale),Gi=cn>=0?1:-1,ts=Ei>=0?1:-1;ts==Gi&&(ts==1?_s==1?cn>=Ei:cn<=Ei:_s==1?cn<=Ei:cn>=Ei)&&(Bs=Qi,pr=jt)}else Bs=Qi,pr=jt}}if(_t||Ct){let Vi,Qi;R.ori==0?(Vi=Ai,Qi=li):(Vi=li,Qi=Ai);let _s,Ei,Gi,ts,xs,ci,Ci=!0,zr=pt.bbox;if(zr!=null){Ci=!1;let hi=zr(n,jt);Gi=hi.left,ts=hi.top,_s=hi.width,Ei=hi.height}else Gi=Vi,ts=Qi,_s=Ei=pt.size(n,jt);if(ci=pt.fill(n,jt),xs=pt.stroke(n,jt),Ct)jt==pr&&Bs<=Vt.prox&&(Ft=Gi,kt=ts,oe=_s,Re=Ei,Ee=Ci,xe=ci,Qt=xs);else{let hi=ce[jt];hi!=null&&(Xe[jt]=Gi,oi[jt]=ts,m0(hi,_s,Ei,Ci),f0(hi,ci,xs),vs(hi,Wi(Gi),Wi(ts),G,Pt))}}}}if(Ct){let jt=Vt.prox,Ye=Br==null?Bs<=jt:Bs>jt||pr!=Br;if(_t||Ye){let ln=ce[0];ln!=null&&(Xe[0]=Ft,oi[0]=kt,m0(ln,oe,Re,Ee),f0(ln,xe,Qt),vs(ln,Wi(Ft),Wi(kt),G,Pt))}}}if(je.show&&dr)if(b!=null){let[yt,St]=xn.scales,[Ot,Ft]=xn.match,[kt,oe]=b.cursor.sync.scales,Re=b.cursor.drag;if(In=Re._x,Nn=Re._y,In||Nn){let{left:Ee,top:xe,width:Qt,height:jt}=b.select,Ye=b.scales[kt].ori,ln=b.posToVal,On,Be,cn,Ai,li,Vi=yt!=null&&Ot(yt,kt),Qi=St!=null&&Ft(St,oe);Vi&&In?(Ye==0?(On=Ee,Be=Qt):(On=xe,Be=jt),cn=v[yt],Ai=k(ln(On,kt),cn,Q,0),li=k(ln(On+Be,kt),cn,Q,0),Ha(is(Ai,li),En(li-Ai))):Ha(0,Q),Qi&&Nn?(Ye==1?(On=Ee,Be=Qt):(On=xe,Be=jt),cn=v[St],Ai=N(ln(On,oe),cn,ft,0),li=N(ln(On+Be,oe),cn,ft,0),Wa(is(Ai,li),En(li-Ai))):Wa(0,ft)}else df()}else{let yt=En(ng-tg),St=En(ig-eg);if(R.ori==1){let oe=yt;yt=St,St=oe}In=Gn.x&&yt>=Gn.dist,Nn=Gn.y&&St>=Gn.dist;let Ot=Gn.uni;Ot!=null?In&&Nn&&(In=yt>=Ot,Nn=St>=Ot,!In&&!Nn&&(St>yt?Nn=!0:In=!0)):Gn.x&&Gn.y&&(In||Nn)&&(In=Nn=!0);let Ft,kt;In&&(R.ori==0?(Ft=Po,kt=qe):(Ft=Lo,kt=Qe),Ha(is(Ft,kt),En(kt-Ft)),Nn||Wa(0,ft)),Nn&&(R.ori==1?(Ft=Po,kt=qe):(Ft=Lo,kt=Qe),Wa(is(Ft,kt),En(kt-Ft)),In||Ha(0,Q)),!In&&!Nn&&(Ha(0,0),Wa(0,0))}if(Gn._x=In,Gn._y=Nn,b==null){if(D){if(gg!=null){let[yt,St]=xn.scales;xn.values[0]=yt!=null?ys(R.ori==0?qe:Qe,yt):null,xn.values[1]=St!=null?ys(R.ori==1?qe:Qe,St):null}qa(wf,n,qe,Qe,G,Pt,U)}if(ne){let yt=D&&xn.setSeries,St=Vt.prox;Br==null?Bs<=St&&gs(pr,No,!0,yt):Bs>St?gs(null,No,!0,yt):pr!=Br&&gs(pr,No,!0,yt)}}_t&&(ht.idx=U,cf()),E!==!1&&Dn("setCursor")}let mr=null;Object.defineProperty(n,"rect",{get(){return mr==null&&Xa(!1),mr}});function Xa(b=!1){b?mr=null:(mr=m.getBoundingClientRect(),Dn("syncRect",mr))}function og(b,E,D,U,q,Q,ft){st._lock||dr&&b!=null&&b.movementX==0&&b.movementY==0||(hf(b,E,D,U,q,Q,ft,!1,b!=null),b!=null?kr(null,!0,!0):kr(E,!0,!1))}function hf(b,E,D,U,q,Q,ft,yt,St){if(mr==null&&Xa(!1),ee(b),b!=null)D=b.clientX-mr.left,U=b.clientY-mr.top;else{if(D<0||U<0){qe=-10,Qe=-10;return}let[Ot,Ft]=xn.scales,kt=E.cursor.sync,[oe,Re]=kt.values,[Ee,xe]=kt.scales,[Qt,jt]=xn.match,Ye=E.axes[0].side%2==1,ln=R.ori==0?G:Pt,On=R.ori==1?G:Pt,Be=Ye?Q:q,cn=Ye?q:Q,Ai=Ye?U:D,li=Ye?D:U;if(Ee!=null?D=Qt(Ot,Ee)?a(oe,v[Ot],ln,0):-10:D=ln*(Ai/Be),xe!=null?U=jt(Ft,xe)?a(Re,v[Ft],On,0):-10:U=On*(li/cn),R.ori==1){let Vi=D;D=U,U=Vi}}St&&(E==null||E.cursor.event.type==wf)&&((D<=1||D>=G-1)&&(D=Xr(D,G)),(U<=1||U>=Pt-1)&&(U=Xr(U,Pt))),yt?(tg=D,eg=U,[Po,Lo]=st.move(n,D,U)):(qe=D,Qe=U)}let uf={width:0,height:0,left:0,top:0};function df(){xc(uf,!1)}let ag,lg,cg,hg;function ug(b,E,D,U,q,Q,ft){dr=!0,In=Nn=Gn._x=Gn._y=!1,hf(b,E,D,U,q,Q,ft,!0,!1),b!=null&&(Me(Tf,Pf,dg,!1),qa(o0,n,Po,Lo,G,Pt,null));let{left:yt,top:St,width:Ot,height:Ft}=je;ag=yt,lg=St,cg=Ot,hg=Ft}function dg(b,E,D,U,q,Q,ft){dr=Gn._x=Gn._y=!1,hf(b,E,D,U,q,Q,ft,!1,!0);let{left:yt,top:St,width:Ot,height:Ft}=je,kt=Ot>0||Ft>0,oe=ag!=yt||lg!=St||cg!=Ot||hg!=Ft;if(kt&&oe&&xc(je),Gn.setScale&&kt&&oe){let Re=yt,Ee=Ot,xe=St,Qt=Ft;if(R.ori==1&&(Re=St,Ee=Ft,xe=yt,Qt=Ot),In&&fr(S,ys(Re,S),ys(Re+Ee,S)),Nn)for(let jt in v){let Ye=v[jt];jt!=S&&Ye.from==null&&Ye.min!=ze&&fr(jt,ys(xe+Qt,jt),ys(xe,jt))}df()}else st.lock&&(st._lock=!st._lock,kr(E,!0,b!=null));b!=null&&(Mn(Tf,Pf),qa(Tf,n,qe,Qe,G,Pt,null))}function Ib(b,E,D,U,q,Q,ft){if(st._lock)return;ee(b);let yt=dr;if(dr){let St=!0,Ot=!0,Ft=10,kt,oe;R.ori==0?(kt=In,oe=Nn):(kt=Nn,oe=In),kt&&oe&&(St=qe<=Ft||qe>=G-Ft,Ot=Qe<=Ft||Qe>=Pt-Ft),kt&&St&&(qe=qe<Po?0:G),oe&&Ot&&(Qe=Qe<Lo?0:Pt),kr(null,!0,!0),dr=!1}qe=-10,Qe=-10,tt.fill(null),kr(null,!0,!0),yt&&(dr=yt)}function fg(b,E,D,U,q,Q,ft){st._lock||(ee(b),Ga(),df(),b!=null&&qa(c0,n,qe,Qe,G,Pt,null))}function pg(){w.forEach(Aw),V(n.width,n.height,!0)}Yr(Xc,Uo,pg);let Do={};Do.mousedown=ug,Do.mousemove=og,Do.mouseup=dg,Do.dblclick=fg,Do.setSeries=(b,E,D,U)=>{let q=xn.match[2];D=q(n,E,D),D!=-1&&gs(D,U,!0,!1)},rt&&(Me(o0,m,ug),Me(wf,m,og),Me(a0,m,b=>{ee(b),Xa(!1)}),Me(l0,m,Ib),Me(c0,m,fg),Bf.add(n),n.syncRect=Xa);let vc=n.hooks=s.hooks||{};function Dn(b,E,D){ai?Fe.push([b,E,D]):b in vc&&vc[b].forEach(U=>{U.call(null,n,E,D)})}(s.plugins||[]).forEach(b=>{for(let E in b.hooks)vc[E]=(vc[E]||[]).concat(b.hooks[E])});let mg=(b,E,D)=>D,xn=vn({key:null,setSeries:!1,filters:{pub:v0,sub:v0},scales:[S,_[1]?_[1].scale:null],match:[b0,b0,mg],values:[null,null]},st.sync);xn.match.length==2&&xn.match.push(mg),st.sync=xn;let gg=xn.key,ff=yy(gg);function qa(b,E,D,U,q,Q,ft){xn.filters.pub(b,E,D,U,q,Q,ft)&&ff.pub(b,E,D,U,q,Q,ft)}ff.sub(n);function Nb(b,E,D,U,q,Q,ft){xn.filters.sub(b,E,D,U,q,Q,ft)&&Do[b](null,E,D,U,q,Q,ft)}n.pub=Nb;function Db(){ff.unsub(n),Bf.delete(n),Ln.clear(),Nf(Xc,Uo,pg),c.remove(),lt?.remove(),Dn("destroy")}n.destroy=Db;function pf(){Dn("init",s,t),Va(t||s.data,!1),W[S]?of(S,W[S]):Ga(),ct=je.show&&(je.width>0||je.height>0),ot=_t=!0,V(s.width,s.height)}return _.forEach(wo),w.forEach(Ds),e?e instanceof HTMLElement?(e.appendChild(c),pf()):e(n,pf):pf(),n}Fn.assign=vn;Fn.fmtNum=Xf;Fn.rangeNum=qc;Fn.rangeLog=$c;Fn.rangeAsinh=Hf;Fn.orient=Jr;Fn.pxRatio=Pe;Fn.join=yM;Fn.fmtDate=jf,Fn.tzDate=CM;Fn.sync=yy;{Fn.addGap=hw,Fn.clipGaps=Zc;let s=Fn.paths={points:My};s.linear=Ty,s.stepped=fw,s.bars=pw,s.spline=gw}var Ry=window.matchMedia("(prefers-color-scheme: dark)");function tp(){let s=Ri("theme");return s==="light"||s==="dark"?s:Ry.matches?"dark":"light"}function Py(s){let t=()=>{document.documentElement.dataset.theme=tp(),s(tp())};return Ry.addEventListener("change",t),t(),{flip:()=>{ui("theme",tp()==="dark"?"light":"dark"),t()}}}function Gs(s){return getComputedStyle(document.documentElement).getPropertyValue(`--${s}`).trim()}var Ew=60,Cw=.2,Iy={show:!1},Ly=.02,Kr=class{constructor(t,e,n,i=null){this.title=t;this.unit=e;this.lines=n;this.always=i;this.legend=B("div",{class:"chart-legend"}),this.place=B("div",{class:"chart-plot",tabindex:0,role:"group","aria-label":`${t} over time; the left and right arrow keys move the cursor`});let r=B("span",{class:"chart-title"},t,B("span",{class:"fine"},e));this.element=B("figure",{class:"chart"},B("figcaption",{},r,this.legend),this.place),this.place.addEventListener("keydown",o=>this.moveCursor(o)),new ResizeObserver(()=>this.fit()).observe(this.place)}title;unit;lines;always;element;place;legend;plot=null;table=[[]];range=[0,1];get series(){return this.lines}setLines(t){JSON.stringify(t)!==JSON.stringify(this.lines)&&(this.lines=t,this.rebuild())}show(t,e){this.table=[t[0],...this.columns().map(n=>t[n+1]??[])],this.range=e,this.plot===null?this.rebuild():this.plot.setData(this.table),this.plot!==null&&(this.plot.cursor.left??-1)<0&&t[0].length>0&&this.plot.setLegend({idx:t[0].length-1})}rebuild(){this.plot?.destroy(),this.plot=null;let{clientWidth:t,clientHeight:e}=this.place;if(t>0&&e>=Ew){let n={width:t,height:e};this.plot=new Fn({...this.options(),...n},this.table,this.place),this.fit()}}picture(t,e,n){return new Promise(i=>{let o={legend:{show:!1},cursor:{show:!1},hooks:{draw:[a=>{i(n(a.ctx.canvas)),queueMicrotask(()=>a.destroy())}]}};new Fn({...this.options(),width:t,height:e,...o},this.table,B("div"))})}fit(){let{clientWidth:t,clientHeight:e}=this.place;this.plot===null?this.rebuild():e>0&&!this.fits()&&this.plot.setSize({width:t,height:e})}fits(){let{clientWidth:t,clientHeight:e}=this.place;return t===this.plot?.width&&e===this.plot.height}moveCursor(t){let e={ArrowLeft:-Ly,ArrowRight:Ly}[t.key];if(this.plot!==null&&e!==void 0){let n=this.plot.over.clientWidth,i=this.plot.cursor.left??-1,r=(i<0?n:i)+e*n;this.plot.setCursor({left:Math.min(n-1,Math.max(0,r)),top:1})}}options(){let t={stroke:Gs("grid"),width:1},e={stroke:Gs("muted"),grid:t,ticks:{show:!1},font:"11px system-ui"};return{scales:{x:{time:!1,range:()=>this.range},y:{range:(n,i,r)=>this.spanOf(i,r)}},axes:[{...e,size:22,gap:4,values:(n,i)=>i.map(Lw)},{...e,size:38,gap:4}],series:[{label:"t",value:(n,i)=>i===null?"\u2013":Vr(i)},...this.lines.map(n=>this.solid(n)),...this.withWanted().map(Rw)],cursor:{y:!1,drag:{x:!1,y:!1},sync:{key:"amr"}},legend:{mount:(n,i)=>this.legend.replaceChildren(i),markers:{width:2}}}}withWanted(){return this.lines.filter(({wanted:t})=>t!==void 0)}columns(){return[...this.lines.map(({column:t})=>t),...this.withWanted().map(Pw)]}solid(t){let e=this.withWanted().indexOf(t),n=(i,r,o,a)=>{let l=i.data[1+this.lines.length+e]?.[a??-1];return e<0?we(r,2):`${we(r,2)} / ${we(l,2)}`};return{label:t.name,stroke:Gs(t.colour),width:1.5,points:Iy,value:n}}spanOf(t,e){let n=Math.min(t??0,this.always?.[0]??1/0),i=Math.max(e??0,this.always?.[1]??-1/0),r=Math.max((i-n)*.08,(Cw-(i-n))/2);return[n-r,i+r]}};function Rw(s){return{class:"wanted",stroke:Gs(s.colour),width:1,dash:[4,4],points:Iy}}function Pw({wanted:s,column:t}){return s??t}function Lw(s){return s>1e8?Vr(s):`${Number(s.toFixed(2))}`}function Ny(s,t){let e=[s.map(Iw).join(",")];for(let n=0;n<t[0].length;n+=1)e.push(t.map(i=>Nw(i[n])).join(","));return`${e.join(`\r
`)}\r
`}function Iw(s){return/[",\r\n]/.test(s)?`"${s.replaceAll('"','""')}"`:s}function Nw(s){return s==null?"":String(Number(s.toFixed(6)))}var Dy=800,ep=190,np=26,sl=14;async function Oy(s){let t=window.devicePixelRatio,e=document.createElement("canvas"),n=e.getContext("2d");if(n===null)return null;e.width=(Dy+2*sl)*t,e.height=(s.length*(np+ep)+2*sl)*t,n.fillStyle=Gs("surface"),n.fillRect(0,0,e.width,e.height);for(let[i,r]of s.entries()){let o=(sl+i*(np+ep))*t;Dw(n,r,sl*t,o+16*t,t),await r.picture(Dy,ep,a=>{n.drawImage(a,sl*t,o+np*t)})}return new Promise(i=>e.toBlob(i,"image/png"))}function Dw(s,{title:t,unit:e,series:n},i,r,o){let a=(l,c,h)=>{s.font=`${h} ${12*o}px system-ui, sans-serif`,s.fillStyle=c,s.fillText(l,i,r),i+=s.measureText(l).width+12*o};a(`${t}, ${e}`,Gs("text"),600);for(let l of n)a(l.name,Gs(l.colour),500)}var nh=class{constructor(t,e,n){this.columns=t;this.span=e;this.capacity=n;this.times=new Float64Array(n),this.values=new Float32Array(n*t)}columns;span;capacity;times;values;count=0;next=0;get length(){return this.count}get latest(){return this.count===0?Number.NaN:this.times[this.index(this.count-1)]}push(t,e){if(t<this.latest&&this.clear(),!(this.count>0&&t-this.latest<.99*this.span/this.capacity)){this.times[this.next]=t;for(let n=0;n<this.columns;n+=1)this.values[this.next*this.columns+n]=e[n];this.next=(this.next+1)%this.capacity,this.count=Math.min(this.count+1,this.capacity)}}clear(){this.count=0,this.next=0}since(t){let e=0,n=this.count;for(;e<n;){let o=e+n>>1;this.times[this.index(o)]<t?e=o+1:n=o}let i=this.count-e,r=[new Array(i)];for(let o=0;o<this.columns;o+=1)r.push(new Array(i));for(let o=0;o<i;o+=1){let a=this.index(e+o);r[0][o]=this.times[a];for(let l=0;l<this.columns;l+=1){let c=this.values[a*this.columns+l];r[l+1][o]=Number.isNaN(c)?null:c}}return r}index(t){return(this.next-this.count+t+this.capacity)%this.capacity}};var Zr=300,Ow=60,Fw={velocity:Number.NaN,commanded:Number.NaN},ip=2*ks.length,Uw=ip+1;function Fy(s,t){return 2*s+(t==="linear"?0:1)}function sp(s,t){return Uw+2*s+(t==="measured"?0:1)}var ih=class{constructor(t){this.turning=t}turning;records=new Map;record(t,e){for(let{id:n}of t.layout.robots){let i=gr(t,n);i!==null&&this.recordRobot(t,i,e??Number.NaN)}}of(t){return t===void 0?null:this.records.get(t)??null}clear(){this.records.clear()}keep(t){for(let e of[...this.records.keys()])t.includes(e)||this.records.delete(e)}get length(){let t=0;for(let{history:e}of this.records.values())t+=e.length;return t}recordRobot(t,e,n){let i=this.wheelsOf(t,e),r=new Map(Tc(t,e).map(h=>[h.name,h])),o=i.flatMap(h=>{let{velocity:u,commanded:d}=r.get(h)??Fw;return[u,d]}),l=[...ks.flatMap(h=>{let{linear:u,angular:d}=wc(e,h);return[u,d]}),n,...o],c=this.records.get(e.id);(c===void 0||c.wheels.join()!==i.join())&&(c={wheels:i,history:new nh(l.length,Zr,Zr*Ow)},this.records.set(e.id,c)),c.history.push(t.time,l)}wheelsOf(t,e){let n=Ac(t,e).map(({name:i})=>i);return n.length>0?n:[...this.turning(e.id)]}};var Uy=[10,30,60,120,Zr],By=100,Bw=500,kw=6,sh=class{constructor(t,e){this.app=t;this.recorder=e;this.charts=[new Kr("Linear velocity","m/s",ky("linear")),new Kr("Angular velocity","rad/s",ky("angular")),new Kr("Wheel speeds","rad/s, commanded dashed",[]),new Kr("Real-time factor","\xD7",[{name:"real",colour:"accent",column:ip}],[0,1])],this.charts[2].element.classList.add("wide"),this.charts[3].element.classList.add("narrow"),this.element=B("section",{class:"plots","aria-label":"Plots"},this.tools(),B("div",{class:"charts"},...this.charts.map(n=>n.element))),t.store.watch(["graph","robot","reset"],()=>this.draw())}app;recorder;id="plots";title="Plots";element;charts;window=Ec("window",Uy[0],Zr,30);paused=null;drawnAt=0;pulse(t){let e=By+(Bw-By)*(this.window/Zr);this.paused===null&&performance.now()-this.drawnAt>=.9*e&&this.draw()}repaint(){for(let t of this.charts)t.rebuild()}draw(){this.drawnAt=performance.now();let t=this.recorder.of(this.app.store.robot?.id),{table:e,end:n}=this.paused??this.current(t);this.charts[2].setLines(zw(t?.wheels??[])),this.charts[3].element.hidden=this.app.store.simulator===null;for(let i of this.charts)i.show(e,[n-this.window,n])}current(t){if(t===null)return{table:[[]],end:this.window};let e=t.history.latest;return{table:t.history.since(e-this.window),end:Number.isNaN(e)?0:e}}tools(){let t=B("select",{"aria-label":"Window of time"},...Uy.map(e=>B("option",{value:e},e<60?`${e} s`:`${e/60} min`)));return t.value=String(this.window),t.addEventListener("change",()=>{this.window=Number(t.value),ui("window",t.value),this.draw()}),B("div",{class:"plot-tools",role:"toolbar","aria-label":"Plots"},B("h2",{},"Plots"),t,ja("Pause",!1,e=>this.pause(e),"Hold the plots; recording goes on"),B("span",{class:"grow"}),$e("CSV",()=>this.saveCsv(),{kind:"quiet",title:"Save these samples as CSV"}),$e("PNG",()=>{this.savePng()},{kind:"quiet",title:"Save an image"}))}pause(t){let e=this.recorder.of(this.app.store.robot?.id),n=e?.history.latest??0;this.paused=t&&e!==null?{table:e.history.since(n-Zr),end:n}:null,this.draw()}saveCsv(){let t=this.recorder.of(this.app.store.robot?.id),{table:e,end:n}=this.paused??this.current(t),i=e[0].findIndex(a=>a>=n-this.window),r=e.map(a=>a.slice(Math.max(0,i))),o=["time_s",...Vw(t?.wheels??[])];Ja("velocities.csv",new Blob([Ny(o,r)],{type:"text/csv"}))}async savePng(){let t=await Oy(this.charts.filter(e=>!e.element.hidden));t===null?this.app.store.note("warning","This browser could not draw the image."):Ja("plots.png",t)}};function ky(s){return ks.map((t,e)=>({name:t,colour:t,column:Fy(e,s)}))}function zw(s){return s.map((t,e)=>({name:t.replace(/^(joint_)?(wheel_)?/,"").replace(/(_wheel)?(_joint)?$/,""),colour:`wheel-${e%kw}`,column:sp(e,"measured"),wanted:sp(e,"commanded")}))}function Vw(s){return[...ks.flatMap(t=>[`${t}_linear_m_s`,`${t}_angular_rad_s`]),"real_time_factor",...s.flatMap(t=>[`${t}_rad_s`,`${t}_commanded_rad_s`])]}var zy=1,Xi=class extends Error{name="BadState"};function Hw(s){let t=7*s.frames.length;for(let{joints:e,wheels:n}of s.robots)t+=3*e.length+20+3,t+=4*n.length;return 16+4*t}function Gy(s,t){if(s.byteLength<16)throw new Xi(`a frame of ${s.byteLength} bytes, less than its header`);let e=new DataView(s,0,16);if(e.getUint8(0)!==zy)throw new Xi(`a frame of kind ${e.getUint8(0)}, not ${zy}`);if(e.getUint16(2,!0)!==t.id)return null;let n=Hw(t);if(s.byteLength!==n)throw new Xi(`a state of ${s.byteLength} bytes; layout ${t.id} asks for ${n}`);let i=new Float32Array(s,16),r=0,o=a=>i.subarray(r,r+=a);return{layout:t,sequence:e.getUint32(4,!0),time:e.getFloat64(8,!0),poses:o(7*t.frames.length),robots:t.robots.map(({id:a,joints:l,wheels:c})=>({id:a,positions:o(l.length),velocities:o(l.length),commanded:o(l.length),odometry:o(10),truth:o(10),command:o(3),wheels:o(4*c.length)}))}}function rh(s,t=0){for(let e=t;e<t+7;e++)if(!Number.isFinite(s[e]))return!1;return!0}var ap=4,oh=3,Hy={rgb:3,intensity:4,none:0},Xw=new Set(["scan","cloud","picture","range","contacts","unreadable"]);function Wy(s){return s.byteLength>0&&new Uint8Array(s,0,1)[0]===2}function Xy(s){if(s.byteLength<4)throw new Xi(`a sample of ${s.byteLength} bytes`);let t=new DataView(s).getUint16(2,!0),e=4+t;if(t%ap!==0||e>s.byteLength)throw new Xi(`a sample of ${s.byteLength} bytes, ${t} of them a head`);let n=qw(new TextDecoder().decode(new Uint8Array(s,4,t))),i=Math.floor((s.byteLength-e)/ap);return{head:n,floats:new Float32Array(s,e,i),bytes:new Uint8Array(s,e)}}function qy({head:s,floats:t,bytes:e}){let n=s.type==="cloud"?s.colouring:"none",i=ap*oh,r=Math.floor(e.length/(i+Hy[n])),o=t.subarray(0,oh*r),a=e.subarray(i*r,(i+Hy.rgb)*r),l=t.subarray(oh*r,(oh+1)*r);return{count:r,positions:o,rgb:n==="rgb"?a:null,intensities:n==="intensity"?l:null}}function qw(s){let t;try{t=JSON.parse(s)}catch{throw new Xi("a sample whose head is no JSON")}if(typeof t?.origin?.topic!="string"||!Xw.has(t.type??""))throw new Xi(`a sample of type ${String(t?.type)}`);return t}var jw=new Set(["scan"]),ah=class{constructor(t){this.store=t;t.watch(["graph","robot"],()=>this.settle()),t.watch(["reset"],()=>{this.latest.clear(),this.onChange()})}store;latest=new Map;onChange=()=>{};get here(){let{graph:t,robot:e}=this.store;return(t?.sensors??[]).filter(n=>n.robot===e?.id)}isOn({topic:t,kind:e}){let n=Ri(`sensor.${t}`);return n===null?jw.has(e):n==="yes"}set(t,e){ui(`sensor.${t}`,e?"yes":"no"),this.settle()}get shown(){return this.here.filter(t=>this.isOn(t))}get inScene(){return this.shown.filter(({kind:t})=>t!=="picture")}take(t){let{topic:e}=t.head.origin,n=this.shown.find(i=>i.topic===e)??null;return n!==null&&this.latest.set(e,t),n}settle(){let t=new Set(this.shown.map(({topic:e})=>e));for(let e of[...this.latest.keys()])t.has(e)||this.latest.delete(e);this.onChange()}};var Yw="(max-width: 760px)";function jy({store:s},{view:t,drive:e,plots:n,tabs:i}){let r=B("div",{class:"dock"}),o=$e("",()=>f(!1),{icon:"close",title:"Close the panels"}),a=B("div",{class:"sheet-head"},B("h2",{},"Panels"),o),l=B("aside",{class:"sheet","aria-label":"Panels"},a,i.element),c={id:"plots",title:"Plots",element:B("div",{class:"plots-slot"})};e.element.id="drive",e.element.tabIndex=-1,i.add(c),document.body.append(t.element,r,e.element,l);let h=window.matchMedia(Yw),u=$e("",()=>d(!r.classList.contains("folded")),{kind:"quiet"});n.element.querySelector(".plot-tools")?.append(u);function d(y){r.classList.toggle("folded",y),document.body.classList.toggle("folded",y),u.textContent=y?"Show":"Hide",u.setAttribute("aria-expanded",String(!y)),ui("folded",y?"yes":"no")}function f(y){l.dataset.sheet=y?"open":"closed",l.inert=h.matches&&!y,y&&o.focus()}function m(){(h.matches?c.element:r).append(n.element),i.setHidden("plots",!h.matches),f(!1)}return s.watch(["graph","robot","controllers"],()=>{let{robot:y,movedJoints:p}=s,g=y===null||y.command!==null||y.odometry!==null;document.body.classList.toggle("still",!g),document.body.classList.toggle("armed",p.size>0),(y?.joint_publisher!=null||!g&&p.size>0)&&i.suggest("joints")}),h.addEventListener("change",m),d(Ri("folded")==="yes"),m(),{openPanels:()=>f(l.dataset.sheet!=="open"),pulse:y=>{n.element.querySelector(".charts")?.checkVisibility()===!0&&n.pulse?.(y)}}}var lh=class{constructor(t){this.store=t;t.watch(["layout"],()=>{this.latest=null,this.isFresh=!1})}store;counts={states:0,skipped:0,stale:0,bad:0,sensed:0};latest=null;arrivedAt=Number.NaN;isFresh=!1;takeSample(t){let e=this.attempt(()=>Xy(t));return this.counts.sensed+=e===null?0:1,this.isFresh||=e!==null,e}take(t){let e=this.decode(t);return e===null?null:(this.latest!==null&&(this.counts.skipped+=Math.max(0,e.sequence-this.latest.sequence-1)),this.counts.states+=1,this.arrivedAt=performance.now(),this.latest=e,this.isFresh=!0,e)}fresh(){let t=this.isFresh?this.latest:null;return this.isFresh=!1,t}decode(t){let{layout:e}=this.store;return this.attempt(()=>{let n=e===null?null:Gy(t,e);return this.counts.stale+=n===null?1:0,n})}attempt(t){try{return t()}catch(e){if(!(e instanceof Xi))throw e;return this.counts.bad+=1,this.store.note("error",`The node sent ${e.message}.`),null}}};var ch=class{link={state:"connecting"};hello=null;graph=null;layout=null;fixedFrame=null;selection=null;models=new Map;worlds=new Map;simulations=new Map;controllers=new Map;diagnostics=new Map;drivers=new Map;notices=[];onModel=()=>{};onWorld=()=>{};chosen=null;listeners=new Map;watch(t,e){for(let n of t){let i=this.listeners.get(n)??new Set;this.listeners.set(n,i.add(e))}e()}get robot(){let t=this.graph?.robots??[];return t.find(({id:n})=>n===this.chosen)??t.find(({command:n})=>n!==null)??t[0]??null}get client(){return this.hello?.client??null}get simulator(){return this.graph?.simulators[0]??null}get simulation(){return this.simulator===null?null:this.simulations.get(this.simulator.id)??null}get model(){return this.robot===null?null:this.models.get(this.robot.id)??null}turningJoints(t){return(this.models.get(t)?.joints??[]).filter(({kind:n})=>n==="continuous").map(({name:n})=>n)}get driver(){let t=this.robot===null?null:this.drivers.get(this.robot.id)??null;return t===null?null:{me:t===this.client,name:t}}get deafController(){let t=this.robot?.command?.topic.split("/")??[],e=this.robot===null?void 0:this.controllers.get(this.robot.id),[n]=t.slice(-2),i=e?.controllers.find(r=>r.name===n);return i===void 0||i.state==="active"?null:i}get goesSideways(){return((this.robot===null?void 0:this.controllers.get(this.robot.id))?.controllers.filter(({state:n})=>n==="active")??[]).some(({kind:n})=>/mecanum|omni|planar/i.test(n))}get movedJoints(){let e=(this.robot===null?void 0:this.controllers.get(this.robot.id))?.controllers.flatMap(({name:n,moves:i})=>i.map(r=>[r,n]));return new Map(e)}choose(t){this.chosen=t,this.tell("robot")}setLink(t){this.link=t,this.tell("link")}setFixedFrame(t){this.fixedFrame=t,this.tell("frame")}select(t){this.selection=t,this.tell("selection")}note(t,e){let[n]=this.notices;n!==void 0&&n.text===e&&n.level===t?(n.count+=1,n.at=new Date):(this.notices.unshift({type:"notice",level:t,text:e,count:1,at:new Date}),this.notices.length=Math.min(this.notices.length,50)),this.tell("notice")}clearNotices(){this.notices.length=0,this.tell("notice")}take(t){switch(t.type){case"hello":return this.begin(t);case"graph":return this.setGraph(t);case"model":return this.models.set(t.robot,t),this.onModel(t),this.tell("model");case"world":return this.worlds.set(t.simulator,t),this.onWorld(t),this.tell("world");case"layout":return this.layout=t,this.tell("layout");case"simulation":return this.simulations.set(t.simulator,t),this.tell("simulation");case"reset":return this.tell("reset");case"controllers":return this.controllers.set(t.robot,t),this.tell("controllers");case"diagnostics":return this.diagnostics.set(t.robot,t),this.tell("diagnostics");case"driver":return this.drivers.set(t.robot,t.client),this.tell("driver");case"reply":return t.ok?void 0:this.note("error",t.message);case"notice":return this.note(t.level,t.text)}}begin(t){let e=this.hello;if(this.hello=t,this.setGraph({type:"graph",robots:[],simulators:[],hint:null,sensors:[]}),this.layout=null,this.tell("layout"),this.tell("hello"),e!==null&&e.version!==t.version){let n=`${e.version} \u2192 ${t.version}`;this.note("warning",`The node was updated (${n}): reload this page to match it.`)}}setGraph(t){this.graph=t;let e=new Set(t.robots.map(i=>i.id)),n=new Set(t.simulators.map(i=>i.id));for(let i of[this.models,this.controllers,this.diagnostics,this.drivers])Yy(i,e);for(let i of[this.worlds,this.simulations])Yy(i,n);this.selection!==null&&!e.has(this.selection.robot)&&(this.selection=null),this.tell("graph")}tell(t){for(let e of this.listeners.get(t)??[])e()}};function Yy(s,t){for(let e of[...s.keys()])t.has(e)||s.delete(e)}var hh=class{constructor(t){this.name=t;this.element.append(this.list),this.list.addEventListener("keydown",e=>this.move(e))}name;element=B("div",{class:"panels"});list=B("div",{class:"tabs",role:"tablist","aria-label":"Panels"});tabs=[];active=null;add(t){let e=B("span",{class:"badge",hidden:!0}),n=B("button",{type:"button",role:"tab",id:`tab-${t.id}`,"aria-controls":`panel-${t.id}`,onclick:()=>this.show(t.id)},B("span",{},t.title),e),i=B("div",{class:"panel",role:"tabpanel",id:`panel-${t.id}`,"aria-labelledby":`tab-${t.id}`,tabindex:0,hidden:!0},t.element);this.tabs.push({panel:t,button:n,badge:e,body:i}),this.list.append(n),this.element.append(i),this.show(Ri(this.name)??this.tabs[0].panel.id,!1)}setHidden(t,e){let n=this.tabs.find(({panel:i})=>i.id===t);n!==void 0&&(n.button.hidden=e,e&&n===this.active&&this.show(this.tabs[0].panel.id,!1))}setBadge(t,e,n){let i=this.tabs.find(({panel:r})=>r.id===t);i!==void 0&&(i.badge.hidden=e===0,i.badge.dataset.tone=n,he(i.badge,String(e)),i.badge.setAttribute("aria-label",`${e} to look at`))}show(t,e=!0){let n=this.tabs.find(({panel:i,button:r})=>i.id===t&&!r.hidden);this.active=n??this.tabs[0];for(let i of this.tabs){let r=i===this.active;i.body.hidden=!r,i.button.tabIndex=r?0:-1,i.button.setAttribute("aria-selected",String(r))}this.active?.button.scrollIntoView({inline:"nearest",block:"nearest"}),n!==void 0&&e&&ui(this.name,t)}suggest(t){Ri(this.name)===null&&this.show(t,!1)}get watches(){return this.isVisible&&this.active?.panel.watches||[]}get topics(){return this.isVisible&&this.active?.panel.topics||[]}pulse(t){this.isVisible&&this.active?.panel.pulse?.(t)}get isVisible(){return this.element.closest("[inert]")===null}move(t){let e=this.tabs.filter(({button:o})=>!o.hidden),n=e.findIndex(o=>o===this.active),i={ArrowRight:(n+1)%e.length,ArrowLeft:(n-1+e.length)%e.length,Home:0,End:e.length-1},r=e[i[t.key]];r!==void 0&&(t.preventDefault(),this.show(r.panel.id),r.button.focus())}};var Pr={LEFT:0,MIDDLE:1,RIGHT:2,ROTATE:0,DOLLY:1,PAN:2},Lr={ROTATE:0,PAN:1,DOLLY_PAN:2,DOLLY_ROTATE:3},G_=0,Yp=1,H_=2;var $p=0,mo=1,W_=2,Aa=3,Es=0,jn=1,yi=2,go=0,Ea=1,Jp=2,Kp=3,Zp=4,X_=5;var yo=100,q_=101,j_=102,Y_=103,$_=104,J_=200,K_=201,Z_=202,Q_=203,Qp=204,tm=205,tx=206,ex=207,nx=208,ix=209,sx=210,rx=211,ox=212,ax=213,lx=214,Wh=0,Xh=1,qh=2,ha=3,jh=4,Yh=5,$h=6,Jh=7,$l=0,cx=1,hx=2,Cs=0,em=1,nm=2,im=3,sm=4,rm=5,om=6,am=7,Np="attached",ux="detached",lm=300,_o=301,Ca=302,gu=303,yu=304,Js=1e3,pi=1001,Kh=1002,kn=1003,dx=1004;var Jl=1005;var Bn=1006,_u=1007;var $i=1008;var Si=1009,cm=1010,hm=1011,Ra=1012,xu=1013,us=1014,ki=1015,ds=1016,vu=1017,bu=1018,xo=1020,um=35902,dm=35899,fm=1021,pm=1022,Ji=1023,Ks=1026,sr=1027,Su=1028,Mu=1029,Ir=1030,wu=1031;var Tu=1033,Kl=33776,Zl=33777,Ql=33778,tc=33779,Au=35840,Eu=35841,Cu=35842,Ru=35843,Pu=36196,Lu=37492,Iu=37496,Nu=37488,Du=37489,ec=37490,Ou=37491,Fu=37808,Uu=37809,Bu=37810,ku=37811,zu=37812,Vu=37813,Gu=37814,Hu=37815,Wu=37816,Xu=37817,qu=37818,ju=37819,Yu=37820,$u=37821,Ju=36492,Ku=36494,Zu=36495,Qu=36283,td=36284,nc=36285,ed=36286;var so=2300,Zh=2301,Gh=2302,yl=2303,Dp=2400,Op=2401,Fp=2402,fx=2500;var px=3200;var ic=0,mx=1,rr="",Te="srgb",_l="srgb-linear",xl="linear",Ne="srgb";var Hh=7680;var gx=519,yx=512,_x=513,xx=514,mm=515,vx=516,bx=517,gm=518,ym=519,_m=35044,or=35048;var xm="300 es",ji=2e3,ua=2001;function $w(s){for(let t=s.length-1;t>=0;--t)if(s[t]>=65535)return!0;return!1}function Jw(s){return ArrayBuffer.isView(s)&&!(s instanceof DataView)}function da(s){return document.createElementNS("http://www.w3.org/1999/xhtml",s)}function Sx(){let s=da("canvas");return s.style.display="block",s}var $y={},fa=null;function vl(...s){let t="THREE."+s.shift();fa?fa("log",t,...s):console.log(t,...s)}function Mx(s){let t=s[0];if(typeof t=="string"&&t.startsWith("TSL:")){let e=s[1];e&&e.isStackTrace?s[0]+=" "+e.getLocation():s[1]='Stack trace not available. Enable "THREE.Node.captureStackTrace" to capture stack traces.'}return s}function Yt(...s){s=Mx(s);let t="THREE."+s.shift();if(fa)fa("warn",t,...s);else{let e=s[0];e&&e.isStackTrace?console.warn(e.getError(t)):console.warn(t,...s)}}function te(...s){s=Mx(s);let t="THREE."+s.shift();if(fa)fa("error",t,...s);else{let e=s[0];e&&e.isStackTrace?console.error(e.getError(t)):console.error(t,...s)}}function ml(...s){let t=s.join(" ");t in $y||($y[t]=!0,Yt(...s))}function wx(s,t,e){return new Promise(function(n,i){function r(){switch(s.clientWaitSync(t,s.SYNC_FLUSH_COMMANDS_BIT,0)){case s.WAIT_FAILED:i();break;case s.TIMEOUT_EXPIRED:setTimeout(r,e);break;default:n()}}setTimeout(r,e)})}var Tx={[Wh]:Wh,[qh]:$h,[jh]:jh,[ha]:Yh,[Xh]:Xh,[$h]:qh,[Jh]:Jh,[Yh]:ha},ls=class{addEventListener(t,e){this._listeners===void 0&&(this._listeners={});let n=this._listeners;n[t]===void 0&&(n[t]=[]),n[t].indexOf(e)===-1&&n[t].push(e)}hasEventListener(t,e){let n=this._listeners;return n===void 0?!1:n[t]!==void 0&&n[t].indexOf(e)!==-1}removeEventListener(t,e){let n=this._listeners;if(n===void 0)return;let i=n[t];if(i!==void 0){let r=i.indexOf(e);r!==-1&&i.splice(r,1)}}dispatchEvent(t){let e=this._listeners;if(e===void 0)return;let n=e[t.type];if(n!==void 0){t.target=this;let i=n.slice(0);for(let r=0,o=i.length;r<o;r++)i[r].call(this,t);t.target=null}}},Qn=["00","01","02","03","04","05","06","07","08","09","0a","0b","0c","0d","0e","0f","10","11","12","13","14","15","16","17","18","19","1a","1b","1c","1d","1e","1f","20","21","22","23","24","25","26","27","28","29","2a","2b","2c","2d","2e","2f","30","31","32","33","34","35","36","37","38","39","3a","3b","3c","3d","3e","3f","40","41","42","43","44","45","46","47","48","49","4a","4b","4c","4d","4e","4f","50","51","52","53","54","55","56","57","58","59","5a","5b","5c","5d","5e","5f","60","61","62","63","64","65","66","67","68","69","6a","6b","6c","6d","6e","6f","70","71","72","73","74","75","76","77","78","79","7a","7b","7c","7d","7e","7f","80","81","82","83","84","85","86","87","88","89","8a","8b","8c","8d","8e","8f","90","91","92","93","94","95","96","97","98","99","9a","9b","9c","9d","9e","9f","a0","a1","a2","a3","a4","a5","a6","a7","a8","a9","aa","ab","ac","ad","ae","af","b0","b1","b2","b3","b4","b5","b6","b7","b8","b9","ba","bb","bc","bd","be","bf","c0","c1","c2","c3","c4","c5","c6","c7","c8","c9","ca","cb","cc","cd","ce","cf","d0","d1","d2","d3","d4","d5","d6","d7","d8","d9","da","db","dc","dd","de","df","e0","e1","e2","e3","e4","e5","e6","e7","e8","e9","ea","eb","ec","ed","ee","ef","f0","f1","f2","f3","f4","f5","f6","f7","f8","f9","fa","fb","fc","fd","fe","ff"],Jy=1234567,aa=Math.PI/180,ro=180/Math.PI;function Rs(){let s=Math.random()*4294967295|0,t=Math.random()*4294967295|0,e=Math.random()*4294967295|0,n=Math.random()*4294967295|0;return(Qn[s&255]+Qn[s>>8&255]+Qn[s>>16&255]+Qn[s>>24&255]+"-"+Qn[t&255]+Qn[t>>8&255]+"-"+Qn[t>>16&15|64]+Qn[t>>24&255]+"-"+Qn[e&63|128]+Qn[e>>8&255]+"-"+Qn[e>>16&255]+Qn[e>>24&255]+Qn[n&255]+Qn[n>>8&255]+Qn[n>>16&255]+Qn[n>>24&255]).toLowerCase()}function le(s,t,e){return Math.max(t,Math.min(e,s))}function vm(s,t){return(s%t+t)%t}function Kw(s,t,e,n,i){return n+(s-t)*(i-n)/(e-t)}function Zw(s,t,e){return s!==t?(e-s)/(t-s):0}function gl(s,t,e){return(1-e)*s+e*t}function Qw(s,t,e,n){return gl(s,t,1-Math.exp(-e*n))}function tT(s,t=1){return t-Math.abs(vm(s,t*2)-t)}function eT(s,t,e){return s<=t?0:s>=e?1:(s=(s-t)/(e-t),s*s*(3-2*s))}function nT(s,t,e){return s<=t?0:s>=e?1:(s=(s-t)/(e-t),s*s*s*(s*(s*6-15)+10))}function iT(s,t){return s+Math.floor(Math.random()*(t-s+1))}function sT(s,t){return s+Math.random()*(t-s)}function rT(s){return s*(.5-Math.random())}function oT(s){s!==void 0&&(Jy=s);let t=Jy+=1831565813;return t=Math.imul(t^t>>>15,t|1),t^=t+Math.imul(t^t>>>7,t|61),((t^t>>>14)>>>0)/4294967296}function aT(s){return s*aa}function lT(s){return s*ro}function cT(s){return s>0&&Number.isInteger(s)&&2**Math.round(Math.log2(s))===s}function hT(s){return Math.pow(2,Math.ceil(Math.log(s)/Math.LN2))}function bm(s){return Math.pow(2,Math.floor(Math.log(s)/Math.LN2))}function uT(s,t,e,n,i){let r=Math.cos,o=Math.sin,a=r(e/2),l=o(e/2),c=r((t+n)/2),h=o((t+n)/2),u=r((t-n)/2),d=o((t-n)/2),f=r((n-t)/2),m=o((n-t)/2);switch(i){case"XYX":s.set(a*h,l*u,l*d,a*c);break;case"YZY":s.set(l*d,a*h,l*u,a*c);break;case"ZXZ":s.set(l*u,l*d,a*h,a*c);break;case"XZX":s.set(a*h,l*m,l*f,a*c);break;case"YXY":s.set(l*f,a*h,l*m,a*c);break;case"ZYZ":s.set(l*m,l*f,a*h,a*c);break;default:Yt("MathUtils: .setQuaternionFromProperEuler() encountered an unknown order: "+i)}}function nd(s){switch(s.constructor){case Uint32Array:return 4294967295;case Uint16Array:return 65535;case Uint8Array:case Uint8ClampedArray:return 255;case Int32Array:return 2147483647;case Int16Array:return 32767;case Int8Array:return 127;default:return}}function Sm(s,t){if(t.constructor===Float32Array)return s;let e=nd(t);if(e===void 0)throw new Error("THREE.MathUtils: Invalid component type.");return Math.max(s/e,-1)}function Mm(s,t){if(t.constructor===Float32Array)return s;let e=nd(t);if(e===void 0)throw new Error("THREE.MathUtils: Invalid component type.");return Math.round(s*e)}var ii={DEG2RAD:aa,RAD2DEG:ro,generateUUID:Rs,clamp:le,euclideanModulo:vm,mapLinear:Kw,inverseLerp:Zw,lerp:gl,damp:Qw,pingpong:tT,smoothstep:eT,smootherstep:nT,randInt:iT,randFloat:sT,randFloatSpread:rT,seededRandom:oT,degToRad:aT,radToDeg:lT,isPowerOfTwo:cT,ceilPowerOfTwo:hT,floorPowerOfTwo:bm,setQuaternionFromProperEuler:uT,normalize:Mm,denormalize:Sm},Xt=class{static{this.prototype.isVector2=!0}constructor(t=0,e=0){this.x=t,this.y=e}get width(){return this.x}set width(t){this.x=t}get height(){return this.y}set height(t){this.y=t}set(t,e){return this.x=t,this.y=e,this}setScalar(t){return this.x=t,this.y=t,this}setX(t){return this.x=t,this}setY(t){return this.y=t,this}setComponent(t,e){switch(t){case 0:this.x=e;break;case 1:this.y=e;break;default:throw new Error("THREE.Vector2: index is out of range: "+t)}return this}getComponent(t){switch(t){case 0:return this.x;case 1:return this.y;default:throw new Error("THREE.Vector2: index is out of range: "+t)}}clone(){return new this.constructor(this.x,this.y)}copy(t){return this.x=t.x,this.y=t.y,this}add(t){return this.x+=t.x,this.y+=t.y,this}addScalar(t){return this.x+=t,this.y+=t,this}addVectors(t,e){return this.x=t.x+e.x,this.y=t.y+e.y,this}addScaledVector(t,e){return this.x+=t.x*e,this.y+=t.y*e,this}sub(t){return this.x-=t.x,this.y-=t.y,this}subScalar(t){return this.x-=t,this.y-=t,this}subVectors(t,e){return this.x=t.x-e.x,this.y=t.y-e.y,this}multiply(t){return this.x*=t.x,this.y*=t.y,this}multiplyScalar(t){return this.x*=t,this.y*=t,this}divide(t){return this.x/=t.x,this.y/=t.y,this}divideScalar(t){return this.multiplyScalar(1/t)}applyMatrix3(t){let e=this.x,n=this.y,i=t.elements;return this.x=i[0]*e+i[3]*n+i[6],this.y=i[1]*e+i[4]*n+i[7],this}min(t){return this.x=Math.min(this.x,t.x),this.y=Math.min(this.y,t.y),this}max(t){return this.x=Math.max(this.x,t.x),this.y=Math.max(this.y,t.y),this}clamp(t,e){return this.x=le(this.x,t.x,e.x),this.y=le(this.y,t.y,e.y),this}clampScalar(t,e){return this.x=le(this.x,t,e),this.y=le(this.y,t,e),this}clampLength(t,e){let n=this.length();return this.divideScalar(n||1).multiplyScalar(le(n,t,e))}floor(){return this.x=Math.floor(this.x),this.y=Math.floor(this.y),this}ceil(){return this.x=Math.ceil(this.x),this.y=Math.ceil(this.y),this}round(){return this.x=Math.round(this.x),this.y=Math.round(this.y),this}roundToZero(){return this.x=Math.trunc(this.x),this.y=Math.trunc(this.y),this}negate(){return this.x=-this.x,this.y=-this.y,this}dot(t){return this.x*t.x+this.y*t.y}cross(t){return this.x*t.y-this.y*t.x}lengthSq(){return this.x*this.x+this.y*this.y}length(){return Math.sqrt(this.x*this.x+this.y*this.y)}manhattanLength(){return Math.abs(this.x)+Math.abs(this.y)}normalize(){return this.divideScalar(this.length()||1)}angle(){return Math.atan2(-this.y,-this.x)+Math.PI}angleTo(t){let e=Math.sqrt(this.lengthSq()*t.lengthSq());if(e===0)return Math.PI/2;let n=this.dot(t)/e;return Math.acos(le(n,-1,1))}distanceTo(t){return Math.sqrt(this.distanceToSquared(t))}distanceToSquared(t){let e=this.x-t.x,n=this.y-t.y;return e*e+n*n}manhattanDistanceTo(t){return Math.abs(this.x-t.x)+Math.abs(this.y-t.y)}setLength(t){return this.normalize().multiplyScalar(t)}lerp(t,e){return this.x+=(t.x-this.x)*e,this.y+=(t.y-this.y)*e,this}lerpVectors(t,e,n){return this.x=t.x+(e.x-t.x)*n,this.y=t.y+(e.y-t.y)*n,this}equals(t){return t.x===this.x&&t.y===this.y}fromArray(t,e=0){return this.x=t[e],this.y=t[e+1],this}toArray(t=[],e=0){return t[e]=this.x,t[e+1]=this.y,t}fromBufferAttribute(t,e){return this.x=t.getX(e),this.y=t.getY(e),this}rotateAround(t,e){let n=Math.cos(e),i=Math.sin(e),r=this.x-t.x,o=this.y-t.y;return this.x=r*n-o*i+t.x,this.y=r*i+o*n+t.y,this}random(){return this.x=Math.random(),this.y=Math.random(),this}*[Symbol.iterator](){yield this.x,yield this.y}},We=class{constructor(t=0,e=0,n=0,i=1){this.isQuaternion=!0,this._x=t,this._y=e,this._z=n,this._w=i}static slerpFlat(t,e,n,i,r,o,a){let l=n[i+0],c=n[i+1],h=n[i+2],u=n[i+3],d=r[o+0],f=r[o+1],m=r[o+2],y=r[o+3];if(u!==y||l!==d||c!==f||h!==m){let p=l*d+c*f+h*m+u*y;p<0&&(d=-d,f=-f,m=-m,y=-y,p=-p);let g=1-a;if(p<.9995){let _=Math.acos(p),w=Math.sin(_);g=Math.sin(g*_)/w,a=Math.sin(a*_)/w,l=l*g+d*a,c=c*g+f*a,h=h*g+m*a,u=u*g+y*a}else{l=l*g+d*a,c=c*g+f*a,h=h*g+m*a,u=u*g+y*a;let _=1/Math.sqrt(l*l+c*c+h*h+u*u);l*=_,c*=_,h*=_,u*=_}}t[e]=l,t[e+1]=c,t[e+2]=h,t[e+3]=u}static multiplyQuaternionsFlat(t,e,n,i,r,o){let a=n[i],l=n[i+1],c=n[i+2],h=n[i+3],u=r[o],d=r[o+1],f=r[o+2],m=r[o+3];return t[e]=a*m+h*u+l*f-c*d,t[e+1]=l*m+h*d+c*u-a*f,t[e+2]=c*m+h*f+a*d-l*u,t[e+3]=h*m-a*u-l*d-c*f,t}get x(){return this._x}set x(t){this._x=t,this._onChangeCallback()}get y(){return this._y}set y(t){this._y=t,this._onChangeCallback()}get z(){return this._z}set z(t){this._z=t,this._onChangeCallback()}get w(){return this._w}set w(t){this._w=t,this._onChangeCallback()}set(t,e,n,i){return this._x=t,this._y=e,this._z=n,this._w=i,this._onChangeCallback(),this}clone(){return new this.constructor(this._x,this._y,this._z,this._w)}copy(t){return this._x=t.x,this._y=t.y,this._z=t.z,this._w=t.w,this._onChangeCallback(),this}setFromEuler(t,e=!0){let n=t._x,i=t._y,r=t._z,o=t._order,a=Math.cos,l=Math.sin,c=a(n/2),h=a(i/2),u=a(r/2),d=l(n/2),f=l(i/2),m=l(r/2);switch(o){case"XYZ":this._x=d*h*u+c*f*m,this._y=c*f*u-d*h*m,this._z=c*h*m+d*f*u,this._w=c*h*u-d*f*m;break;case"YXZ":this._x=d*h*u+c*f*m,this._y=c*f*u-d*h*m,this._z=c*h*m-d*f*u,this._w=c*h*u+d*f*m;break;case"ZXY":this._x=d*h*u-c*f*m,this._y=c*f*u+d*h*m,this._z=c*h*m+d*f*u,this._w=c*h*u-d*f*m;break;case"ZYX":this._x=d*h*u-c*f*m,this._y=c*f*u+d*h*m,this._z=c*h*m-d*f*u,this._w=c*h*u+d*f*m;break;case"YZX":this._x=d*h*u+c*f*m,this._y=c*f*u+d*h*m,this._z=c*h*m-d*f*u,this._w=c*h*u-d*f*m;break;case"XZY":this._x=d*h*u-c*f*m,this._y=c*f*u-d*h*m,this._z=c*h*m+d*f*u,this._w=c*h*u+d*f*m;break;default:Yt("Quaternion: .setFromEuler() encountered an unknown order: "+o)}return e===!0&&this._onChangeCallback(),this}setFromAxisAngle(t,e){let n=e/2,i=Math.sin(n);return this._x=t.x*i,this._y=t.y*i,this._z=t.z*i,this._w=Math.cos(n),this._onChangeCallback(),this}setFromRotationMatrix(t){let e=t.elements,n=e[0],i=e[4],r=e[8],o=e[1],a=e[5],l=e[9],c=e[2],h=e[6],u=e[10],d=n+a+u;if(d>0){let f=.5/Math.sqrt(d+1);this._w=.25/f,this._x=(h-l)*f,this._y=(r-c)*f,this._z=(o-i)*f}else if(n>a&&n>u){let f=2*Math.sqrt(1+n-a-u);this._w=(h-l)/f,this._x=.25*f,this._y=(i+o)/f,this._z=(r+c)/f}else if(a>u){let f=2*Math.sqrt(1+a-n-u);this._w=(r-c)/f,this._x=(i+o)/f,this._y=.25*f,this._z=(l+h)/f}else{let f=2*Math.sqrt(1+u-n-a);this._w=(o-i)/f,this._x=(r+c)/f,this._y=(l+h)/f,this._z=.25*f}return this._onChangeCallback(),this}setFromUnitVectors(t,e){let n=t.dot(e)+1;return n<1e-8?(n=0,Math.abs(t.x)>Math.abs(t.z)?(this._x=-t.y,this._y=t.x,this._z=0,this._w=n):(this._x=0,this._y=-t.z,this._z=t.y,this._w=n)):(this._x=t.y*e.z-t.z*e.y,this._y=t.z*e.x-t.x*e.z,this._z=t.x*e.y-t.y*e.x,this._w=n),this.normalize()}angleTo(t){return 2*Math.acos(Math.abs(le(this.dot(t),-1,1)))}rotateTowards(t,e){let n=this.angleTo(t);if(n===0)return this;let i=Math.min(1,e/n);return this.slerp(t,i),this}identity(){return this.set(0,0,0,1)}invert(){return this.conjugate()}conjugate(){return this._x*=-1,this._y*=-1,this._z*=-1,this._onChangeCallback(),this}dot(t){return this._x*t._x+this._y*t._y+this._z*t._z+this._w*t._w}lengthSq(){return this._x*this._x+this._y*this._y+this._z*this._z+this._w*this._w}length(){return Math.sqrt(this._x*this._x+this._y*this._y+this._z*this._z+this._w*this._w)}normalize(){let t=this.length();return t===0?(this._x=0,this._y=0,this._z=0,this._w=1):(t=1/t,this._x=this._x*t,this._y=this._y*t,this._z=this._z*t,this._w=this._w*t),this._onChangeCallback(),this}multiply(t){return this.multiplyQuaternions(this,t)}premultiply(t){return this.multiplyQuaternions(t,this)}multiplyQuaternions(t,e){let n=t._x,i=t._y,r=t._z,o=t._w,a=e._x,l=e._y,c=e._z,h=e._w;return this._x=n*h+o*a+i*c-r*l,this._y=i*h+o*l+r*a-n*c,this._z=r*h+o*c+n*l-i*a,this._w=o*h-n*a-i*l-r*c,this._onChangeCallback(),this}slerp(t,e){let n=t._x,i=t._y,r=t._z,o=t._w,a=this.dot(t);a<0&&(n=-n,i=-i,r=-r,o=-o,a=-a);let l=1-e;if(a<.9995){let c=Math.acos(a),h=Math.sin(c);l=Math.sin(l*c)/h,e=Math.sin(e*c)/h,this._x=this._x*l+n*e,this._y=this._y*l+i*e,this._z=this._z*l+r*e,this._w=this._w*l+o*e,this._onChangeCallback()}else this._x=this._x*l+n*e,this._y=this._y*l+i*e,this._z=this._z*l+r*e,this._w=this._w*l+o*e,this.normalize();return this}slerpQuaternions(t,e,n){return this.copy(t).slerp(e,n)}random(){let t=2*Math.PI*Math.random(),e=2*Math.PI*Math.random(),n=Math.random(),i=Math.sqrt(1-n),r=Math.sqrt(n);return this.set(i*Math.sin(t),i*Math.cos(t),r*Math.sin(e),r*Math.cos(e))}equals(t){return t._x===this._x&&t._y===this._y&&t._z===this._z&&t._w===this._w}fromArray(t,e=0){return this._x=t[e],this._y=t[e+1],this._z=t[e+2],this._w=t[e+3],this._onChangeCallback(),this}toArray(t=[],e=0){return t[e]=this._x,t[e+1]=this._y,t[e+2]=this._z,t[e+3]=this._w,t}fromBufferAttribute(t,e){return this._x=t.getX(e),this._y=t.getY(e),this._z=t.getZ(e),this._w=t.getW(e),this._onChangeCallback(),this}toJSON(){return this.toArray()}_onChange(t){return this._onChangeCallback=t,this}_onChangeCallback(){}*[Symbol.iterator](){yield this._x,yield this._y,yield this._z,yield this._w}},F=class{static{this.prototype.isVector3=!0}constructor(t=0,e=0,n=0){this.x=t,this.y=e,this.z=n}set(t,e,n){return n===void 0&&(n=this.z),this.x=t,this.y=e,this.z=n,this}setScalar(t){return this.x=t,this.y=t,this.z=t,this}setX(t){return this.x=t,this}setY(t){return this.y=t,this}setZ(t){return this.z=t,this}setComponent(t,e){switch(t){case 0:this.x=e;break;case 1:this.y=e;break;case 2:this.z=e;break;default:throw new Error("THREE.Vector3: index is out of range: "+t)}return this}getComponent(t){switch(t){case 0:return this.x;case 1:return this.y;case 2:return this.z;default:throw new Error("THREE.Vector3: index is out of range: "+t)}}clone(){return new this.constructor(this.x,this.y,this.z)}copy(t){return this.x=t.x,this.y=t.y,this.z=t.z,this}add(t){return this.x+=t.x,this.y+=t.y,this.z+=t.z,this}addScalar(t){return this.x+=t,this.y+=t,this.z+=t,this}addVectors(t,e){return this.x=t.x+e.x,this.y=t.y+e.y,this.z=t.z+e.z,this}addScaledVector(t,e){return this.x+=t.x*e,this.y+=t.y*e,this.z+=t.z*e,this}sub(t){return this.x-=t.x,this.y-=t.y,this.z-=t.z,this}subScalar(t){return this.x-=t,this.y-=t,this.z-=t,this}subVectors(t,e){return this.x=t.x-e.x,this.y=t.y-e.y,this.z=t.z-e.z,this}multiply(t){return this.x*=t.x,this.y*=t.y,this.z*=t.z,this}multiplyScalar(t){return this.x*=t,this.y*=t,this.z*=t,this}multiplyVectors(t,e){return this.x=t.x*e.x,this.y=t.y*e.y,this.z=t.z*e.z,this}applyEuler(t){return this.applyQuaternion(Ky.setFromEuler(t))}applyAxisAngle(t,e){return this.applyQuaternion(Ky.setFromAxisAngle(t,e))}applyMatrix3(t){let e=this.x,n=this.y,i=this.z,r=t.elements;return this.x=r[0]*e+r[3]*n+r[6]*i,this.y=r[1]*e+r[4]*n+r[7]*i,this.z=r[2]*e+r[5]*n+r[8]*i,this}applyNormalMatrix(t){return this.applyMatrix3(t).normalize()}applyMatrix4(t){let e=this.x,n=this.y,i=this.z,r=t.elements,o=1/(r[3]*e+r[7]*n+r[11]*i+r[15]);return this.x=(r[0]*e+r[4]*n+r[8]*i+r[12])*o,this.y=(r[1]*e+r[5]*n+r[9]*i+r[13])*o,this.z=(r[2]*e+r[6]*n+r[10]*i+r[14])*o,this}applyQuaternion(t){let e=this.x,n=this.y,i=this.z,r=t.x,o=t.y,a=t.z,l=t.w,c=2*(o*i-a*n),h=2*(a*e-r*i),u=2*(r*n-o*e);return this.x=e+l*c+o*u-a*h,this.y=n+l*h+a*c-r*u,this.z=i+l*u+r*h-o*c,this}project(t){return this.applyMatrix4(t.matrixWorldInverse).applyMatrix4(t.projectionMatrix)}unproject(t){return this.applyMatrix4(t.projectionMatrixInverse).applyMatrix4(t.matrixWorld)}transformDirection(t){let e=this.x,n=this.y,i=this.z,r=t.elements;return this.x=r[0]*e+r[4]*n+r[8]*i,this.y=r[1]*e+r[5]*n+r[9]*i,this.z=r[2]*e+r[6]*n+r[10]*i,this.normalize()}divide(t){return this.x/=t.x,this.y/=t.y,this.z/=t.z,this}divideScalar(t){return this.multiplyScalar(1/t)}min(t){return this.x=Math.min(this.x,t.x),this.y=Math.min(this.y,t.y),this.z=Math.min(this.z,t.z),this}max(t){return this.x=Math.max(this.x,t.x),this.y=Math.max(this.y,t.y),this.z=Math.max(this.z,t.z),this}clamp(t,e){return this.x=le(this.x,t.x,e.x),this.y=le(this.y,t.y,e.y),this.z=le(this.z,t.z,e.z),this}clampScalar(t,e){return this.x=le(this.x,t,e),this.y=le(this.y,t,e),this.z=le(this.z,t,e),this}clampLength(t,e){let n=this.length();return this.divideScalar(n||1).multiplyScalar(le(n,t,e))}floor(){return this.x=Math.floor(this.x),this.y=Math.floor(this.y),this.z=Math.floor(this.z),this}ceil(){return this.x=Math.ceil(this.x),this.y=Math.ceil(this.y),this.z=Math.ceil(this.z),this}round(){return this.x=Math.round(this.x),this.y=Math.round(this.y),this.z=Math.round(this.z),this}roundToZero(){return this.x=Math.trunc(this.x),this.y=Math.trunc(this.y),this.z=Math.trunc(this.z),this}negate(){return this.x=-this.x,this.y=-this.y,this.z=-this.z,this}dot(t){return this.x*t.x+this.y*t.y+this.z*t.z}lengthSq(){return this.x*this.x+this.y*this.y+this.z*this.z}length(){return Math.sqrt(this.x*this.x+this.y*this.y+this.z*this.z)}manhattanLength(){return Math.abs(this.x)+Math.abs(this.y)+Math.abs(this.z)}normalize(){return this.divideScalar(this.length()||1)}setLength(t){return this.normalize().multiplyScalar(t)}lerp(t,e){return this.x+=(t.x-this.x)*e,this.y+=(t.y-this.y)*e,this.z+=(t.z-this.z)*e,this}lerpVectors(t,e,n){return this.x=t.x+(e.x-t.x)*n,this.y=t.y+(e.y-t.y)*n,this.z=t.z+(e.z-t.z)*n,this}cross(t){return this.crossVectors(this,t)}crossVectors(t,e){let n=t.x,i=t.y,r=t.z,o=e.x,a=e.y,l=e.z;return this.x=i*l-r*a,this.y=r*o-n*l,this.z=n*a-i*o,this}projectOnVector(t){let e=t.lengthSq();if(e===0)return this.set(0,0,0);let n=t.dot(this)/e;return this.copy(t).multiplyScalar(n)}projectOnPlane(t){return lp.copy(this).projectOnVector(t),this.sub(lp)}reflect(t){return this.sub(lp.copy(t).multiplyScalar(2*this.dot(t)))}angleTo(t){let e=Math.sqrt(this.lengthSq()*t.lengthSq());if(e===0)return Math.PI/2;let n=this.dot(t)/e;return Math.acos(le(n,-1,1))}distanceTo(t){return Math.sqrt(this.distanceToSquared(t))}distanceToSquared(t){let e=this.x-t.x,n=this.y-t.y,i=this.z-t.z;return e*e+n*n+i*i}manhattanDistanceTo(t){return Math.abs(this.x-t.x)+Math.abs(this.y-t.y)+Math.abs(this.z-t.z)}setFromSpherical(t){return this.setFromSphericalCoords(t.radius,t.phi,t.theta)}setFromSphericalCoords(t,e,n){let i=Math.sin(e)*t;return this.x=i*Math.sin(n),this.y=Math.cos(e)*t,this.z=i*Math.cos(n),this}setFromCylindrical(t){return this.setFromCylindricalCoords(t.radius,t.theta,t.y)}setFromCylindricalCoords(t,e,n){return this.x=t*Math.sin(e),this.y=n,this.z=t*Math.cos(e),this}setFromMatrixPosition(t){let e=t.elements;return this.x=e[12],this.y=e[13],this.z=e[14],this}setFromMatrixScale(t){let e=this.setFromMatrixColumn(t,0).length(),n=this.setFromMatrixColumn(t,1).length(),i=this.setFromMatrixColumn(t,2).length();return this.x=e,this.y=n,this.z=i,this}setFromMatrixColumn(t,e){return this.fromArray(t.elements,e*4)}setFromMatrix3Column(t,e){return this.fromArray(t.elements,e*3)}setFromEuler(t){return this.x=t._x,this.y=t._y,this.z=t._z,this}setFromColor(t){return this.x=t.r,this.y=t.g,this.z=t.b,this}equals(t){return t.x===this.x&&t.y===this.y&&t.z===this.z}fromArray(t,e=0){return this.x=t[e],this.y=t[e+1],this.z=t[e+2],this}toArray(t=[],e=0){return t[e]=this.x,t[e+1]=this.y,t[e+2]=this.z,t}fromBufferAttribute(t,e){return this.x=t.getX(e),this.y=t.getY(e),this.z=t.getZ(e),this}random(){return this.x=Math.random(),this.y=Math.random(),this.z=Math.random(),this}randomDirection(){let t=Math.random()*Math.PI*2,e=Math.random()*2-1,n=Math.sqrt(1-e*e);return this.x=n*Math.cos(t),this.y=e,this.z=n*Math.sin(t),this}*[Symbol.iterator](){yield this.x,yield this.y,yield this.z}},lp=new F,Ky=new We,se=class{static{this.prototype.isMatrix3=!0}constructor(t,e,n,i,r,o,a,l,c){this.elements=[1,0,0,0,1,0,0,0,1],t!==void 0&&this.set(t,e,n,i,r,o,a,l,c)}set(t,e,n,i,r,o,a,l,c){let h=this.elements;return h[0]=t,h[1]=i,h[2]=a,h[3]=e,h[4]=r,h[5]=l,h[6]=n,h[7]=o,h[8]=c,this}identity(){return this.set(1,0,0,0,1,0,0,0,1),this}copy(t){let e=this.elements,n=t.elements;return e[0]=n[0],e[1]=n[1],e[2]=n[2],e[3]=n[3],e[4]=n[4],e[5]=n[5],e[6]=n[6],e[7]=n[7],e[8]=n[8],this}extractBasis(t,e,n){return t.setFromMatrix3Column(this,0),e.setFromMatrix3Column(this,1),n.setFromMatrix3Column(this,2),this}setFromMatrix4(t){let e=t.elements;return this.set(e[0],e[4],e[8],e[1],e[5],e[9],e[2],e[6],e[10]),this}multiply(t){return this.multiplyMatrices(this,t)}premultiply(t){return this.multiplyMatrices(t,this)}multiplyMatrices(t,e){let n=t.elements,i=e.elements,r=this.elements,o=n[0],a=n[3],l=n[6],c=n[1],h=n[4],u=n[7],d=n[2],f=n[5],m=n[8],y=i[0],p=i[3],g=i[6],_=i[1],w=i[4],v=i[7],A=i[2],S=i[5],x=i[8];return r[0]=o*y+a*_+l*A,r[3]=o*p+a*w+l*S,r[6]=o*g+a*v+l*x,r[1]=c*y+h*_+u*A,r[4]=c*p+h*w+u*S,r[7]=c*g+h*v+u*x,r[2]=d*y+f*_+m*A,r[5]=d*p+f*w+m*S,r[8]=d*g+f*v+m*x,this}multiplyScalar(t){let e=this.elements;return e[0]*=t,e[3]*=t,e[6]*=t,e[1]*=t,e[4]*=t,e[7]*=t,e[2]*=t,e[5]*=t,e[8]*=t,this}determinant(){let t=this.elements,e=t[0],n=t[1],i=t[2],r=t[3],o=t[4],a=t[5],l=t[6],c=t[7],h=t[8];return e*o*h-e*a*c-n*r*h+n*a*l+i*r*c-i*o*l}invert(){let t=this.elements,e=t[0],n=t[1],i=t[2],r=t[3],o=t[4],a=t[5],l=t[6],c=t[7],h=t[8],u=h*o-a*c,d=a*l-h*r,f=c*r-o*l,m=e*u+n*d+i*f;if(m===0)return this.set(0,0,0,0,0,0,0,0,0);let y=1/m;return t[0]=u*y,t[1]=(i*c-h*n)*y,t[2]=(a*n-i*o)*y,t[3]=d*y,t[4]=(h*e-i*l)*y,t[5]=(i*r-a*e)*y,t[6]=f*y,t[7]=(n*l-c*e)*y,t[8]=(o*e-n*r)*y,this}transpose(){let t,e=this.elements;return t=e[1],e[1]=e[3],e[3]=t,t=e[2],e[2]=e[6],e[6]=t,t=e[5],e[5]=e[7],e[7]=t,this}getNormalMatrix(t){return this.setFromMatrix4(t).invert().transpose()}transposeIntoArray(t){let e=this.elements;return t[0]=e[0],t[1]=e[3],t[2]=e[6],t[3]=e[1],t[4]=e[4],t[5]=e[7],t[6]=e[2],t[7]=e[5],t[8]=e[8],this}setUvTransform(t,e,n,i,r,o,a){let l=Math.cos(r),c=Math.sin(r);return this.set(n*l,n*c,-n*(l*o+c*a)+o+t,-i*c,i*l,-i*(-c*o+l*a)+a+e,0,0,1),this}scale(t,e){return ml("Matrix3: .scale() is deprecated. Use .makeScale() instead."),this.premultiply(cp.makeScale(t,e)),this}rotate(t){return ml("Matrix3: .rotate() is deprecated. Use .makeRotation() instead."),this.premultiply(cp.makeRotation(-t)),this}translate(t,e){return ml("Matrix3: .translate() is deprecated. Use .makeTranslation() instead."),this.premultiply(cp.makeTranslation(t,e)),this}makeTranslation(t,e){return t.isVector2?this.set(1,0,t.x,0,1,t.y,0,0,1):this.set(1,0,t,0,1,e,0,0,1),this}makeRotation(t){let e=Math.cos(t),n=Math.sin(t);return this.set(e,-n,0,n,e,0,0,0,1),this}makeScale(t,e){return this.set(t,0,0,0,e,0,0,0,1),this}equals(t){let e=this.elements,n=t.elements;for(let i=0;i<9;i++)if(e[i]!==n[i])return!1;return!0}fromArray(t,e=0){for(let n=0;n<9;n++)this.elements[n]=t[n+e];return this}toArray(t=[],e=0){let n=this.elements;return t[e]=n[0],t[e+1]=n[1],t[e+2]=n[2],t[e+3]=n[3],t[e+4]=n[4],t[e+5]=n[5],t[e+6]=n[6],t[e+7]=n[7],t[e+8]=n[8],t}clone(){return new this.constructor().fromArray(this.elements)}},cp=new se,Zy=new se().set(.4123908,.3575843,.1804808,.212639,.7151687,.0721923,.0193308,.1191948,.9505322),Qy=new se().set(3.2409699,-1.5373832,-.4986108,-.9692436,1.8759675,.0415551,.0556301,-.203977,1.0569715);function dT(){let s={enabled:!0,workingColorSpace:_l,spaces:{},convert:function(i,r,o){return this.enabled===!1||r===o||!r||!o||(this.spaces[r].transfer===Ne&&(i.r=$s(i.r),i.g=$s(i.g),i.b=$s(i.b)),this.spaces[r].primaries!==this.spaces[o].primaries&&(i.applyMatrix3(this.spaces[r].toXYZ),i.applyMatrix3(this.spaces[o].fromXYZ)),this.spaces[o].transfer===Ne&&(i.r=la(i.r),i.g=la(i.g),i.b=la(i.b))),i},workingToColorSpace:function(i,r){return this.convert(i,this.workingColorSpace,r)},colorSpaceToWorking:function(i,r){return this.convert(i,r,this.workingColorSpace)},getPrimaries:function(i){return this.spaces[i].primaries},getTransfer:function(i){return i===rr?xl:this.spaces[i].transfer},getToneMappingMode:function(i){return this.spaces[i].outputColorSpaceConfig.toneMappingMode||"standard"},getLuminanceCoefficients:function(i,r=this.workingColorSpace){return i.fromArray(this.spaces[r].luminanceCoefficients)},define:function(i){Object.assign(this.spaces,i)},_getMatrix:function(i,r,o){return i.copy(this.spaces[o].fromXYZ).multiply(this.spaces[r].toXYZ)},_getDrawingBufferColorSpace:function(i){return this.spaces[i].outputColorSpaceConfig.drawingBufferColorSpace},_getUnpackColorSpace:function(i=this.workingColorSpace){return this.spaces[i].workingColorSpaceConfig.unpackColorSpace}},t=[.64,.33,.3,.6,.15,.06],e=[.2126,.7152,.0722],n=[.3127,.329];return s.define({[_l]:{primaries:t,whitePoint:n,transfer:xl,toXYZ:Zy,fromXYZ:Qy,luminanceCoefficients:e,workingColorSpaceConfig:{unpackColorSpace:Te},outputColorSpaceConfig:{drawingBufferColorSpace:Te}},[Te]:{primaries:t,whitePoint:n,transfer:Ne,toXYZ:Zy,fromXYZ:Qy,luminanceCoefficients:e,outputColorSpaceConfig:{drawingBufferColorSpace:Te}}}),s}var ue=dT();function $s(s){return s<.04045?s*.0773993808:Math.pow(s*.9478672986+.0521327014,2.4)}function la(s){return s<.0031308?s*12.92:1.055*Math.pow(s,.41666)-.055}var Xo,Qh=class{static getDataURL(t,e="image/png"){if(/^data:/i.test(t.src)||typeof HTMLCanvasElement>"u")return t.src;let n;if(t instanceof HTMLCanvasElement)n=t;else{Xo===void 0&&(Xo=da("canvas")),Xo.width=t.width,Xo.height=t.height;let i=Xo.getContext("2d");t instanceof ImageData?i.putImageData(t,0,0):i.drawImage(t,0,0,t.width,t.height),n=Xo}return n.toDataURL(e)}static sRGBToLinear(t){if(typeof HTMLImageElement<"u"&&t instanceof HTMLImageElement||typeof HTMLCanvasElement<"u"&&t instanceof HTMLCanvasElement||typeof ImageBitmap<"u"&&t instanceof ImageBitmap){let e=da("canvas");e.width=t.width,e.height=t.height;let n=e.getContext("2d");n.drawImage(t,0,0,t.width,t.height);let i=n.getImageData(0,0,t.width,t.height),r=i.data;for(let o=0;o<r.length;o++)r[o]=$s(r[o]/255)*255;return n.putImageData(i,0,0),e}else if(t.data){let e=t.data.slice(0);for(let n=0;n<e.length;n++)e instanceof Uint8Array||e instanceof Uint8ClampedArray?e[n]=Math.floor($s(e[n]/255)*255):e[n]=$s(e[n]);return{data:e,width:t.width,height:t.height}}else return Yt("ImageUtils.sRGBToLinear(): Unsupported image type. No color space conversion applied."),t}},fT=0,pa=class{constructor(t=null){this.isTextureSource=!0,Object.defineProperty(this,"id",{value:fT++}),this.uuid=Rs(),this.data=t,this.dataReady=!0,this.version=0}getSize(t){let e=this.data;return typeof HTMLVideoElement<"u"&&e instanceof HTMLVideoElement?t.set(e.videoWidth,e.videoHeight,0):typeof VideoFrame<"u"&&e instanceof VideoFrame?t.set(e.displayWidth,e.displayHeight,0):e!==null?t.set(e.width||0,e.height||0,e.depth||0):t.set(0,0,0),t}set needsUpdate(t){t===!0&&this.version++}toJSON(t){let e=t===void 0||typeof t=="string";if(!e&&t.images[this.uuid]!==void 0)return t.images[this.uuid];let n={uuid:this.uuid,url:""},i=this.data;if(i!==null){let r;if(Array.isArray(i)){r=[];for(let o=0,a=i.length;o<a;o++)i[o].isDataTexture?r.push(hp(i[o].image)):r.push(hp(i[o]))}else r=hp(i);n.url=r}return e||(t.images[this.uuid]=n),n}};function hp(s){return typeof HTMLImageElement<"u"&&s instanceof HTMLImageElement||typeof HTMLCanvasElement<"u"&&s instanceof HTMLCanvasElement||typeof ImageBitmap<"u"&&s instanceof ImageBitmap?Qh.getDataURL(s):s.data?{data:Array.from(s.data),width:s.width,height:s.height,type:s.data.constructor.name}:(Yt("Texture: Unable to serialize Texture."),{})}var pT=0,up=new F,mi=class s extends ls{constructor(t=s.DEFAULT_IMAGE,e=s.DEFAULT_MAPPING,n=pi,i=pi,r=Bn,o=$i,a=Ji,l=Si,c=s.DEFAULT_ANISOTROPY,h=rr){super(),this.isTexture=!0,Object.defineProperty(this,"id",{value:pT++}),this.uuid=Rs(),this.name="",this.source=new pa(t),this.mipmaps=[],this.mapping=e,this.channel=0,this.wrapS=n,this.wrapT=i,this.magFilter=r,this.minFilter=o,this.anisotropy=c,this.format=a,this.internalFormat=null,this.type=l,this.offset=new Xt(0,0),this.repeat=new Xt(1,1),this.center=new Xt(0,0),this.rotation=0,this.matrixAutoUpdate=!0,this.matrix=new se,this.generateMipmaps=!0,this.mipmapsAutoUpdate=!0,this.premultiplyAlpha=!1,this.flipY=!0,this.unpackAlignment=4,this.colorSpace=h,this.userData={},this.updateRanges=[],this.version=0,this.onUpdate=null,this.renderTarget=null,this.isRenderTargetTexture=!1,this.isArrayTexture=!!(t&&t.depth&&t.depth>1),this.pmremVersion=0,this.isPMREMTexture=!1,this.normalized=!1}get width(){return this.source.getSize(up).x}get height(){return this.source.getSize(up).y}get depth(){return this.source.getSize(up).z}get image(){return this.source.data}set image(t){this.source.data=t}updateMatrix(){this.matrix.setUvTransform(this.offset.x,this.offset.y,this.repeat.x,this.repeat.y,this.rotation,this.center.x,this.center.y)}addUpdateRange(t,e){this.updateRanges.push({start:t,count:e})}clearUpdateRanges(){this.updateRanges.length=0}clone(){return new this.constructor().copy(this)}copy(t){return this.name=t.name,this.source=t.source,this.mipmaps=t.mipmaps.slice(0),this.mapping=t.mapping,this.channel=t.channel,this.wrapS=t.wrapS,this.wrapT=t.wrapT,this.magFilter=t.magFilter,this.minFilter=t.minFilter,this.anisotropy=t.anisotropy,this.format=t.format,this.internalFormat=t.internalFormat,this.type=t.type,this.normalized=t.normalized,this.offset.copy(t.offset),this.repeat.copy(t.repeat),this.center.copy(t.center),this.rotation=t.rotation,this.matrixAutoUpdate=t.matrixAutoUpdate,this.matrix.copy(t.matrix),this.generateMipmaps=t.generateMipmaps,this.mipmapsAutoUpdate=t.mipmapsAutoUpdate,this.premultiplyAlpha=t.premultiplyAlpha,this.flipY=t.flipY,this.unpackAlignment=t.unpackAlignment,this.colorSpace=t.colorSpace,this.renderTarget=t.renderTarget,this.isRenderTargetTexture=t.isRenderTargetTexture,this.isPMREMTexture=t.isPMREMTexture,this.isArrayTexture=t.isArrayTexture,this.userData=JSON.parse(JSON.stringify(t.userData)),this.needsUpdate=!0,this}setValues(t){for(let e in t){let n=t[e];if(n===void 0){Yt(`Texture.setValues(): parameter '${e}' has value of undefined.`);continue}let i=this[e];if(i===void 0){Yt(`Texture.setValues(): property '${e}' does not exist.`);continue}i&&n&&i.isVector2&&n.isVector2||i&&n&&i.isVector3&&n.isVector3||i&&n&&i.isMatrix3&&n.isMatrix3?i.copy(n):this[e]=n}}toJSON(t){let e=t===void 0||typeof t=="string";if(!e&&t.textures[this.uuid]!==void 0)return t.textures[this.uuid];let n={metadata:{version:4.7,type:"Texture",generator:"Texture.toJSON"},uuid:this.uuid,name:this.name,image:this.source.toJSON(t).uuid,mapping:this.mapping,channel:this.channel,repeat:[this.repeat.x,this.repeat.y],offset:[this.offset.x,this.offset.y],center:[this.center.x,this.center.y],rotation:this.rotation,wrap:[this.wrapS,this.wrapT],format:this.format,internalFormat:this.internalFormat,type:this.type,normalized:this.normalized,colorSpace:this.colorSpace,minFilter:this.minFilter,magFilter:this.magFilter,anisotropy:this.anisotropy,flipY:this.flipY,generateMipmaps:this.generateMipmaps,mipmapsAutoUpdate:this.mipmapsAutoUpdate,premultiplyAlpha:this.premultiplyAlpha,unpackAlignment:this.unpackAlignment};return Object.keys(this.userData).length>0&&(n.userData=this.userData),e||(t.textures[this.uuid]=n),n}dispose(){this.dispatchEvent({type:"dispose"})}transformUv(t){if(this.mapping!==lm)return t;if(t.applyMatrix3(this.matrix),t.x<0||t.x>1)switch(this.wrapS){case Js:t.x=t.x-Math.floor(t.x);break;case pi:t.x=t.x<0?0:1;break;case Kh:Math.abs(Math.floor(t.x)%2)===1?t.x=Math.ceil(t.x)-t.x:t.x=t.x-Math.floor(t.x);break}if(t.y<0||t.y>1)switch(this.wrapT){case Js:t.y=t.y-Math.floor(t.y);break;case pi:t.y=t.y<0?0:1;break;case Kh:Math.abs(Math.floor(t.y)%2)===1?t.y=Math.ceil(t.y)-t.y:t.y=t.y-Math.floor(t.y);break}return this.flipY&&(t.y=1-t.y),t}set needsUpdate(t){t===!0&&(this.version++,this.source.needsUpdate=!0)}set needsPMREMUpdate(t){t===!0&&this.pmremVersion++}};mi.DEFAULT_IMAGE=null;mi.DEFAULT_MAPPING=lm;mi.DEFAULT_ANISOTROPY=1;var Se=class{static{this.prototype.isVector4=!0}constructor(t=0,e=0,n=0,i=1){this.x=t,this.y=e,this.z=n,this.w=i}get width(){return this.z}set width(t){this.z=t}get height(){return this.w}set height(t){this.w=t}set(t,e,n,i){return this.x=t,this.y=e,this.z=n,this.w=i,this}setScalar(t){return this.x=t,this.y=t,this.z=t,this.w=t,this}setX(t){return this.x=t,this}setY(t){return this.y=t,this}setZ(t){return this.z=t,this}setW(t){return this.w=t,this}setComponent(t,e){switch(t){case 0:this.x=e;break;case 1:this.y=e;break;case 2:this.z=e;break;case 3:this.w=e;break;default:throw new Error("THREE.Vector4: index is out of range: "+t)}return this}getComponent(t){switch(t){case 0:return this.x;case 1:return this.y;case 2:return this.z;case 3:return this.w;default:throw new Error("THREE.Vector4: index is out of range: "+t)}}clone(){return new this.constructor(this.x,this.y,this.z,this.w)}copy(t){return this.x=t.x,this.y=t.y,this.z=t.z,this.w=t.w!==void 0?t.w:1,this}add(t){return this.x+=t.x,this.y+=t.y,this.z+=t.z,this.w+=t.w,this}addScalar(t){return this.x+=t,this.y+=t,this.z+=t,this.w+=t,this}addVectors(t,e){return this.x=t.x+e.x,this.y=t.y+e.y,this.z=t.z+e.z,this.w=t.w+e.w,this}addScaledVector(t,e){return this.x+=t.x*e,this.y+=t.y*e,this.z+=t.z*e,this.w+=t.w*e,this}sub(t){return this.x-=t.x,this.y-=t.y,this.z-=t.z,this.w-=t.w,this}subScalar(t){return this.x-=t,this.y-=t,this.z-=t,this.w-=t,this}subVectors(t,e){return this.x=t.x-e.x,this.y=t.y-e.y,this.z=t.z-e.z,this.w=t.w-e.w,this}multiply(t){return this.x*=t.x,this.y*=t.y,this.z*=t.z,this.w*=t.w,this}multiplyScalar(t){return this.x*=t,this.y*=t,this.z*=t,this.w*=t,this}applyMatrix4(t){let e=this.x,n=this.y,i=this.z,r=this.w,o=t.elements;return this.x=o[0]*e+o[4]*n+o[8]*i+o[12]*r,this.y=o[1]*e+o[5]*n+o[9]*i+o[13]*r,this.z=o[2]*e+o[6]*n+o[10]*i+o[14]*r,this.w=o[3]*e+o[7]*n+o[11]*i+o[15]*r,this}divide(t){return this.x/=t.x,this.y/=t.y,this.z/=t.z,this.w/=t.w,this}divideScalar(t){return this.multiplyScalar(1/t)}setAxisAngleFromQuaternion(t){this.w=2*Math.acos(t.w);let e=Math.sqrt(1-t.w*t.w);return e<1e-4?(this.x=1,this.y=0,this.z=0):(this.x=t.x/e,this.y=t.y/e,this.z=t.z/e),this}setAxisAngleFromRotationMatrix(t){let e,n,i,r,l=t.elements,c=l[0],h=l[4],u=l[8],d=l[1],f=l[5],m=l[9],y=l[2],p=l[6],g=l[10];if(Math.abs(h-d)<.01&&Math.abs(u-y)<.01&&Math.abs(m-p)<.01){if(Math.abs(h+d)<.1&&Math.abs(u+y)<.1&&Math.abs(m+p)<.1&&Math.abs(c+f+g-3)<.1)return this.set(1,0,0,0),this;e=Math.PI;let w=(c+1)/2,v=(f+1)/2,A=(g+1)/2,S=(h+d)/4,x=(u+y)/4,M=(m+p)/4;return w>v&&w>A?w<.01?(n=0,i=.707106781,r=.707106781):(n=Math.sqrt(w),i=S/n,r=x/n):v>A?v<.01?(n=.707106781,i=0,r=.707106781):(i=Math.sqrt(v),n=S/i,r=M/i):A<.01?(n=.707106781,i=.707106781,r=0):(r=Math.sqrt(A),n=x/r,i=M/r),this.set(n,i,r,e),this}let _=Math.sqrt((p-m)*(p-m)+(u-y)*(u-y)+(d-h)*(d-h));return Math.abs(_)<.001&&(_=1),this.x=(p-m)/_,this.y=(u-y)/_,this.z=(d-h)/_,this.w=Math.acos((c+f+g-1)/2),this}setFromMatrixPosition(t){let e=t.elements;return this.x=e[12],this.y=e[13],this.z=e[14],this.w=e[15],this}min(t){return this.x=Math.min(this.x,t.x),this.y=Math.min(this.y,t.y),this.z=Math.min(this.z,t.z),this.w=Math.min(this.w,t.w),this}max(t){return this.x=Math.max(this.x,t.x),this.y=Math.max(this.y,t.y),this.z=Math.max(this.z,t.z),this.w=Math.max(this.w,t.w),this}clamp(t,e){return this.x=le(this.x,t.x,e.x),this.y=le(this.y,t.y,e.y),this.z=le(this.z,t.z,e.z),this.w=le(this.w,t.w,e.w),this}clampScalar(t,e){return this.x=le(this.x,t,e),this.y=le(this.y,t,e),this.z=le(this.z,t,e),this.w=le(this.w,t,e),this}clampLength(t,e){let n=this.length();return this.divideScalar(n||1).multiplyScalar(le(n,t,e))}floor(){return this.x=Math.floor(this.x),this.y=Math.floor(this.y),this.z=Math.floor(this.z),this.w=Math.floor(this.w),this}ceil(){return this.x=Math.ceil(this.x),this.y=Math.ceil(this.y),this.z=Math.ceil(this.z),this.w=Math.ceil(this.w),this}round(){return this.x=Math.round(this.x),this.y=Math.round(this.y),this.z=Math.round(this.z),this.w=Math.round(this.w),this}roundToZero(){return this.x=Math.trunc(this.x),this.y=Math.trunc(this.y),this.z=Math.trunc(this.z),this.w=Math.trunc(this.w),this}negate(){return this.x=-this.x,this.y=-this.y,this.z=-this.z,this.w=-this.w,this}dot(t){return this.x*t.x+this.y*t.y+this.z*t.z+this.w*t.w}lengthSq(){return this.x*this.x+this.y*this.y+this.z*this.z+this.w*this.w}length(){return Math.sqrt(this.x*this.x+this.y*this.y+this.z*this.z+this.w*this.w)}manhattanLength(){return Math.abs(this.x)+Math.abs(this.y)+Math.abs(this.z)+Math.abs(this.w)}normalize(){return this.divideScalar(this.length()||1)}setLength(t){return this.normalize().multiplyScalar(t)}lerp(t,e){return this.x+=(t.x-this.x)*e,this.y+=(t.y-this.y)*e,this.z+=(t.z-this.z)*e,this.w+=(t.w-this.w)*e,this}lerpVectors(t,e,n){return this.x=t.x+(e.x-t.x)*n,this.y=t.y+(e.y-t.y)*n,this.z=t.z+(e.z-t.z)*n,this.w=t.w+(e.w-t.w)*n,this}equals(t){return t.x===this.x&&t.y===this.y&&t.z===this.z&&t.w===this.w}fromArray(t,e=0){return this.x=t[e],this.y=t[e+1],this.z=t[e+2],this.w=t[e+3],this}toArray(t=[],e=0){return t[e]=this.x,t[e+1]=this.y,t[e+2]=this.z,t[e+3]=this.w,t}fromBufferAttribute(t,e){return this.x=t.getX(e),this.y=t.getY(e),this.z=t.getZ(e),this.w=t.getW(e),this}random(){return this.x=Math.random(),this.y=Math.random(),this.z=Math.random(),this.w=Math.random(),this}*[Symbol.iterator](){yield this.x,yield this.y,yield this.z,yield this.w}},tu=class extends ls{constructor(t=1,e=1,n={}){super(),n=Object.assign({generateMipmaps:!1,internalFormat:null,minFilter:Bn,depthBuffer:!0,stencilBuffer:!1,resolveColorBuffer:!0,resolveDepthBuffer:!0,resolveStencilBuffer:!0,storeMultisampledColorBuffer:!0,storeMultisampledDepthBuffer:!0,storeMultisampledStencilBuffer:!0,depthTexture:null,samples:0,count:1,depth:1,multiview:!1,useArrayDepthTexture:!1},n),this.isRenderTarget=!0,this.width=t,this.height=e,this.depth=n.depth,this.scissor=new Se(0,0,t,e),this.scissorTest=!1,this.viewport=new Se(0,0,t,e),this.textures=[];let i=n.count;for(let r=0;r<i;r++)this.textures[r]=new mi({width:t,height:e,depth:n.depth}),this.textures[r].isRenderTargetTexture=!0,this.textures[r].renderTarget=this;this._setTextureOptions(n),this.depthBuffer=n.depthBuffer,this.stencilBuffer=n.stencilBuffer,this.resolveColorBuffer=n.resolveColorBuffer,this.resolveDepthBuffer=n.resolveDepthBuffer,this.resolveStencilBuffer=n.resolveStencilBuffer,this.storeMultisampledColorBuffer=n.storeMultisampledColorBuffer,this.storeMultisampledDepthBuffer=n.storeMultisampledDepthBuffer,this.storeMultisampledStencilBuffer=n.storeMultisampledStencilBuffer,this._depthTexture=null,this.depthTexture=n.depthTexture,this.samples=n.samples,this.multiview=n.multiview,this.useArrayDepthTexture=n.useArrayDepthTexture}_setTextureOptions(t={}){let e={minFilter:Bn,generateMipmaps:!1,flipY:!1,internalFormat:null};t.mapping!==void 0&&(e.mapping=t.mapping),t.wrapS!==void 0&&(e.wrapS=t.wrapS),t.wrapT!==void 0&&(e.wrapT=t.wrapT),t.wrapR!==void 0&&(e.wrapR=t.wrapR),t.magFilter!==void 0&&(e.magFilter=t.magFilter),t.minFilter!==void 0&&(e.minFilter=t.minFilter),t.format!==void 0&&(e.format=t.format),t.type!==void 0&&(e.type=t.type),t.anisotropy!==void 0&&(e.anisotropy=t.anisotropy),t.colorSpace!==void 0&&(e.colorSpace=t.colorSpace),t.flipY!==void 0&&(e.flipY=t.flipY),t.generateMipmaps!==void 0&&(e.generateMipmaps=t.generateMipmaps),t.mipmapsAutoUpdate!==void 0&&(e.mipmapsAutoUpdate=t.mipmapsAutoUpdate),t.internalFormat!==void 0&&(e.internalFormat=t.internalFormat);for(let n=0;n<this.textures.length;n++)this.textures[n].setValues(e)}get texture(){return this.textures[0]}set texture(t){this.textures[0]=t}set depthTexture(t){this._depthTexture!==null&&this._depthTexture.renderTarget===this&&(this._depthTexture.renderTarget=null),t!==null&&t.renderTarget===null&&(t.renderTarget=this),this._depthTexture=t}get depthTexture(){return this._depthTexture}setSize(t,e,n=1){if(this.width!==t||this.height!==e||this.depth!==n){this.width=t,this.height=e,this.depth=n;for(let i=0,r=this.textures.length;i<r;i++)this.textures[i].image.width=t,this.textures[i].image.height=e,this.textures[i].image.depth=n,this.textures[i].isData3DTexture!==!0&&(this.textures[i].isArrayTexture=this.textures[i].image.depth>1);this.dispose()}this.viewport.set(0,0,t,e),this.scissor.set(0,0,t,e)}clone(){return new this.constructor().copy(this)}copy(t){this.width=t.width,this.height=t.height,this.depth=t.depth,this.scissor.copy(t.scissor),this.scissorTest=t.scissorTest,this.viewport.copy(t.viewport),this.textures.length=0;for(let e=0,n=t.textures.length;e<n;e++){this.textures[e]=t.textures[e].clone(),this.textures[e].isRenderTargetTexture=!0,this.textures[e].renderTarget=this;let i=Object.assign({},t.textures[e].image);this.textures[e].source=new pa(i)}if(this.depthBuffer=t.depthBuffer,this.stencilBuffer=t.stencilBuffer,this.resolveColorBuffer=t.resolveColorBuffer,this.resolveDepthBuffer=t.resolveDepthBuffer,this.resolveStencilBuffer=t.resolveStencilBuffer,this.storeMultisampledColorBuffer=t.storeMultisampledColorBuffer,this.storeMultisampledDepthBuffer=t.storeMultisampledDepthBuffer,this.storeMultisampledStencilBuffer=t.storeMultisampledStencilBuffer,t.depthTexture!==null)if(t.depthTexture.renderTarget===t){let e=t.depthTexture.clone();e.renderTarget=null,this.depthTexture=e}else this.depthTexture=t.depthTexture;else this.depthTexture=null;return this.samples=t.samples,this.multiview=t.multiview,this.useArrayDepthTexture=t.useArrayDepthTexture,this}dispose(){this.dispatchEvent({type:"dispose"})}},Fi=class extends tu{constructor(t=1,e=1,n={}){super(t,e,n),this.isWebGLRenderTarget=!0}},bl=class extends mi{constructor(t=null,e=1,n=1,i=1){super(null),this.isDataArrayTexture=!0,this.image={data:t,width:e,height:n,depth:i},this.magFilter=kn,this.minFilter=kn,this.wrapR=pi,this.generateMipmaps=!1,this.flipY=!1,this.unpackAlignment=1,this.layerUpdates=new Set}copy(t){return super.copy(t),this.wrapR=t.wrapR,this}addLayerUpdate(t){this.layerUpdates.add(t)}clearLayerUpdates(){this.layerUpdates.clear()}};var eu=class extends mi{constructor(t=null,e=1,n=1,i=1){super(null),this.isData3DTexture=!0,this.image={data:t,width:e,height:n,depth:i},this.magFilter=kn,this.minFilter=kn,this.wrapR=pi,this.generateMipmaps=!1,this.flipY=!1,this.unpackAlignment=1}copy(t){return super.copy(t),this.wrapR=t.wrapR,this}};var Nt=class s{static{this.prototype.isMatrix4=!0}constructor(t,e,n,i,r,o,a,l,c,h,u,d,f,m,y,p){this.elements=[1,0,0,0,0,1,0,0,0,0,1,0,0,0,0,1],t!==void 0&&this.set(t,e,n,i,r,o,a,l,c,h,u,d,f,m,y,p)}set(t,e,n,i,r,o,a,l,c,h,u,d,f,m,y,p){let g=this.elements;return g[0]=t,g[4]=e,g[8]=n,g[12]=i,g[1]=r,g[5]=o,g[9]=a,g[13]=l,g[2]=c,g[6]=h,g[10]=u,g[14]=d,g[3]=f,g[7]=m,g[11]=y,g[15]=p,this}identity(){return this.set(1,0,0,0,0,1,0,0,0,0,1,0,0,0,0,1),this}clone(){return new s().fromArray(this.elements)}copy(t){let e=this.elements,n=t.elements;return e[0]=n[0],e[1]=n[1],e[2]=n[2],e[3]=n[3],e[4]=n[4],e[5]=n[5],e[6]=n[6],e[7]=n[7],e[8]=n[8],e[9]=n[9],e[10]=n[10],e[11]=n[11],e[12]=n[12],e[13]=n[13],e[14]=n[14],e[15]=n[15],this}copyPosition(t){let e=this.elements,n=t.elements;return e[12]=n[12],e[13]=n[13],e[14]=n[14],this}setFromMatrix3(t){let e=t.elements;return this.set(e[0],e[3],e[6],0,e[1],e[4],e[7],0,e[2],e[5],e[8],0,0,0,0,1),this}extractBasis(t,e,n){return this.determinantAffine()===0?(t.set(1,0,0),e.set(0,1,0),n.set(0,0,1),this):(t.setFromMatrixColumn(this,0),e.setFromMatrixColumn(this,1),n.setFromMatrixColumn(this,2),this)}makeBasis(t,e,n){return this.set(t.x,e.x,n.x,0,t.y,e.y,n.y,0,t.z,e.z,n.z,0,0,0,0,1),this}extractRotation(t){if(t.determinantAffine()===0)return this.identity();let e=this.elements,n=t.elements,i=1/qo.setFromMatrixColumn(t,0).length(),r=1/qo.setFromMatrixColumn(t,1).length(),o=1/qo.setFromMatrixColumn(t,2).length();return e[0]=n[0]*i,e[1]=n[1]*i,e[2]=n[2]*i,e[3]=0,e[4]=n[4]*r,e[5]=n[5]*r,e[6]=n[6]*r,e[7]=0,e[8]=n[8]*o,e[9]=n[9]*o,e[10]=n[10]*o,e[11]=0,e[12]=0,e[13]=0,e[14]=0,e[15]=1,this}makeRotationFromEuler(t){let e=this.elements,n=t.x,i=t.y,r=t.z,o=Math.cos(n),a=Math.sin(n),l=Math.cos(i),c=Math.sin(i),h=Math.cos(r),u=Math.sin(r);if(t.order==="XYZ"){let d=o*h,f=o*u,m=a*h,y=a*u;e[0]=l*h,e[4]=-l*u,e[8]=c,e[1]=f+m*c,e[5]=d-y*c,e[9]=-a*l,e[2]=y-d*c,e[6]=m+f*c,e[10]=o*l}else if(t.order==="YXZ"){let d=l*h,f=l*u,m=c*h,y=c*u;e[0]=d+y*a,e[4]=m*a-f,e[8]=o*c,e[1]=o*u,e[5]=o*h,e[9]=-a,e[2]=f*a-m,e[6]=y+d*a,e[10]=o*l}else if(t.order==="ZXY"){let d=l*h,f=l*u,m=c*h,y=c*u;e[0]=d-y*a,e[4]=-o*u,e[8]=m+f*a,e[1]=f+m*a,e[5]=o*h,e[9]=y-d*a,e[2]=-o*c,e[6]=a,e[10]=o*l}else if(t.order==="ZYX"){let d=o*h,f=o*u,m=a*h,y=a*u;e[0]=l*h,e[4]=m*c-f,e[8]=d*c+y,e[1]=l*u,e[5]=y*c+d,e[9]=f*c-m,e[2]=-c,e[6]=a*l,e[10]=o*l}else if(t.order==="YZX"){let d=o*l,f=o*c,m=a*l,y=a*c;e[0]=l*h,e[4]=y-d*u,e[8]=m*u+f,e[1]=u,e[5]=o*h,e[9]=-a*h,e[2]=-c*h,e[6]=f*u+m,e[10]=d-y*u}else if(t.order==="XZY"){let d=o*l,f=o*c,m=a*l,y=a*c;e[0]=l*h,e[4]=-u,e[8]=c*h,e[1]=d*u+y,e[5]=o*h,e[9]=f*u-m,e[2]=m*u-f,e[6]=a*h,e[10]=y*u+d}return e[3]=0,e[7]=0,e[11]=0,e[12]=0,e[13]=0,e[14]=0,e[15]=1,this}makeRotationFromQuaternion(t){return this.compose(mT,t,gT)}lookAt(t,e,n){let i=this.elements;return Ni.subVectors(t,e),Ni.lengthSq()===0&&(Ni.z=1),Ni.normalize(),xr.crossVectors(n,Ni),xr.lengthSq()===0&&(Math.abs(n.z)===1?Ni.x+=1e-4:Ni.z+=1e-4,Ni.normalize(),xr.crossVectors(n,Ni)),xr.normalize(),uh.crossVectors(Ni,xr),i[0]=xr.x,i[4]=uh.x,i[8]=Ni.x,i[1]=xr.y,i[5]=uh.y,i[9]=Ni.y,i[2]=xr.z,i[6]=uh.z,i[10]=Ni.z,this}multiply(t){return this.multiplyMatrices(this,t)}premultiply(t){return this.multiplyMatrices(t,this)}multiplyMatrices(t,e){let n=t.elements,i=e.elements,r=this.elements,o=n[0],a=n[4],l=n[8],c=n[12],h=n[1],u=n[5],d=n[9],f=n[13],m=n[2],y=n[6],p=n[10],g=n[14],_=n[3],w=n[7],v=n[11],A=n[15],S=i[0],x=i[4],M=i[8],L=i[12],P=i[1],R=i[5],O=i[9],k=i[13],N=i[2],W=i[6],z=i[10],H=i[14],it=i[3],Y=i[7],K=i[11],tt=i[15];return r[0]=o*S+a*P+l*N+c*it,r[4]=o*x+a*R+l*W+c*Y,r[8]=o*M+a*O+l*z+c*K,r[12]=o*L+a*k+l*H+c*tt,r[1]=h*S+u*P+d*N+f*it,r[5]=h*x+u*R+d*W+f*Y,r[9]=h*M+u*O+d*z+f*K,r[13]=h*L+u*k+d*H+f*tt,r[2]=m*S+y*P+p*N+g*it,r[6]=m*x+y*R+p*W+g*Y,r[10]=m*M+y*O+p*z+g*K,r[14]=m*L+y*k+p*H+g*tt,r[3]=_*S+w*P+v*N+A*it,r[7]=_*x+w*R+v*W+A*Y,r[11]=_*M+w*O+v*z+A*K,r[15]=_*L+w*k+v*H+A*tt,this}multiplyScalar(t){let e=this.elements;return e[0]*=t,e[4]*=t,e[8]*=t,e[12]*=t,e[1]*=t,e[5]*=t,e[9]*=t,e[13]*=t,e[2]*=t,e[6]*=t,e[10]*=t,e[14]*=t,e[3]*=t,e[7]*=t,e[11]*=t,e[15]*=t,this}determinant(){let t=this.elements,e=t[0],n=t[4],i=t[8],r=t[12],o=t[1],a=t[5],l=t[9],c=t[13],h=t[2],u=t[6],d=t[10],f=t[14],m=t[3],y=t[7],p=t[11],g=t[15],_=l*f-c*d,w=a*f-c*u,v=a*d-l*u,A=o*f-c*h,S=o*d-l*h,x=o*u-a*h;return e*(y*_-p*w+g*v)-n*(m*_-p*A+g*S)+i*(m*w-y*A+g*x)-r*(m*v-y*S+p*x)}determinantAffine(){let t=this.elements,e=t[0],n=t[4],i=t[8],r=t[1],o=t[5],a=t[9],l=t[2],c=t[6],h=t[10];return e*(o*h-a*c)-n*(r*h-a*l)+i*(r*c-o*l)}transpose(){let t=this.elements,e;return e=t[1],t[1]=t[4],t[4]=e,e=t[2],t[2]=t[8],t[8]=e,e=t[6],t[6]=t[9],t[9]=e,e=t[3],t[3]=t[12],t[12]=e,e=t[7],t[7]=t[13],t[13]=e,e=t[11],t[11]=t[14],t[14]=e,this}setPosition(t,e,n){let i=this.elements;return t.isVector3?(i[12]=t.x,i[13]=t.y,i[14]=t.z):(i[12]=t,i[13]=e,i[14]=n),this}invert(){let t=this.elements,e=t[0],n=t[1],i=t[2],r=t[3],o=t[4],a=t[5],l=t[6],c=t[7],h=t[8],u=t[9],d=t[10],f=t[11],m=t[12],y=t[13],p=t[14],g=t[15],_=e*a-n*o,w=e*l-i*o,v=e*c-r*o,A=n*l-i*a,S=n*c-r*a,x=i*c-r*l,M=h*y-u*m,L=h*p-d*m,P=h*g-f*m,R=u*p-d*y,O=u*g-f*y,k=d*g-f*p,N=_*k-w*O+v*R+A*P-S*L+x*M;if(N===0)return this.set(0,0,0,0,0,0,0,0,0,0,0,0,0,0,0,0);let W=1/N;return t[0]=(a*k-l*O+c*R)*W,t[1]=(i*O-n*k-r*R)*W,t[2]=(y*x-p*S+g*A)*W,t[3]=(d*S-u*x-f*A)*W,t[4]=(l*P-o*k-c*L)*W,t[5]=(e*k-i*P+r*L)*W,t[6]=(p*v-m*x-g*w)*W,t[7]=(h*x-d*v+f*w)*W,t[8]=(o*O-a*P+c*M)*W,t[9]=(n*P-e*O-r*M)*W,t[10]=(m*S-y*v+g*_)*W,t[11]=(u*v-h*S-f*_)*W,t[12]=(a*L-o*R-l*M)*W,t[13]=(e*R-n*L+i*M)*W,t[14]=(y*w-m*A-p*_)*W,t[15]=(h*A-u*w+d*_)*W,this}scale(t){let e=this.elements,n=t.x,i=t.y,r=t.z;return e[0]*=n,e[4]*=i,e[8]*=r,e[1]*=n,e[5]*=i,e[9]*=r,e[2]*=n,e[6]*=i,e[10]*=r,e[3]*=n,e[7]*=i,e[11]*=r,this}getMaxScaleOnAxis(){let t=this.elements,e=t[0]*t[0]+t[1]*t[1]+t[2]*t[2],n=t[4]*t[4]+t[5]*t[5]+t[6]*t[6],i=t[8]*t[8]+t[9]*t[9]+t[10]*t[10];return Math.sqrt(Math.max(e,n,i))}makeTranslation(t,e,n){return t.isVector3?this.set(1,0,0,t.x,0,1,0,t.y,0,0,1,t.z,0,0,0,1):this.set(1,0,0,t,0,1,0,e,0,0,1,n,0,0,0,1),this}makeRotationX(t){let e=Math.cos(t),n=Math.sin(t);return this.set(1,0,0,0,0,e,-n,0,0,n,e,0,0,0,0,1),this}makeRotationY(t){let e=Math.cos(t),n=Math.sin(t);return this.set(e,0,n,0,0,1,0,0,-n,0,e,0,0,0,0,1),this}makeRotationZ(t){let e=Math.cos(t),n=Math.sin(t);return this.set(e,-n,0,0,n,e,0,0,0,0,1,0,0,0,0,1),this}makeRotationAxis(t,e){let n=Math.cos(e),i=Math.sin(e),r=1-n,o=t.x,a=t.y,l=t.z,c=r*o,h=r*a;return this.set(c*o+n,c*a-i*l,c*l+i*a,0,c*a+i*l,h*a+n,h*l-i*o,0,c*l-i*a,h*l+i*o,r*l*l+n,0,0,0,0,1),this}makeScale(t,e,n){return this.set(t,0,0,0,0,e,0,0,0,0,n,0,0,0,0,1),this}makeShear(t,e,n,i,r,o){return this.set(1,n,r,0,t,1,o,0,e,i,1,0,0,0,0,1),this}compose(t,e,n){let i=this.elements,r=e._x,o=e._y,a=e._z,l=e._w,c=r+r,h=o+o,u=a+a,d=r*c,f=r*h,m=r*u,y=o*h,p=o*u,g=a*u,_=l*c,w=l*h,v=l*u,A=n.x,S=n.y,x=n.z;return i[0]=(1-(y+g))*A,i[1]=(f+v)*A,i[2]=(m-w)*A,i[3]=0,i[4]=(f-v)*S,i[5]=(1-(d+g))*S,i[6]=(p+_)*S,i[7]=0,i[8]=(m+w)*x,i[9]=(p-_)*x,i[10]=(1-(d+y))*x,i[11]=0,i[12]=t.x,i[13]=t.y,i[14]=t.z,i[15]=1,this}decompose(t,e,n){let i=this.elements;t.x=i[12],t.y=i[13],t.z=i[14];let r=this.determinantAffine();if(r===0)return n.set(1,1,1),e.identity(),this;let o=qo.set(i[0],i[1],i[2]).length(),a=qo.set(i[4],i[5],i[6]).length(),l=qo.set(i[8],i[9],i[10]).length();r<0&&(o=-o),ss.copy(this);let c=1/o,h=1/a,u=1/l;return ss.elements[0]*=c,ss.elements[1]*=c,ss.elements[2]*=c,ss.elements[4]*=h,ss.elements[5]*=h,ss.elements[6]*=h,ss.elements[8]*=u,ss.elements[9]*=u,ss.elements[10]*=u,e.setFromRotationMatrix(ss),n.x=o,n.y=a,n.z=l,this}makePerspective(t,e,n,i,r,o,a=ji,l=!1){let c=this.elements,h=2*r/(e-t),u=2*r/(n-i),d=(e+t)/(e-t),f=(n+i)/(n-i),m,y;if(l)m=r/(o-r),y=o*r/(o-r);else if(a===ji)m=-(o+r)/(o-r),y=-2*o*r/(o-r);else if(a===ua)m=-o/(o-r),y=-o*r/(o-r);else throw new Error("THREE.Matrix4.makePerspective(): Invalid coordinate system: "+a);return c[0]=h,c[4]=0,c[8]=d,c[12]=0,c[1]=0,c[5]=u,c[9]=f,c[13]=0,c[2]=0,c[6]=0,c[10]=m,c[14]=y,c[3]=0,c[7]=0,c[11]=-1,c[15]=0,this}makeOrthographic(t,e,n,i,r,o,a=ji,l=!1){let c=this.elements,h=2/(e-t),u=2/(n-i),d=-(e+t)/(e-t),f=-(n+i)/(n-i),m,y;if(l)m=1/(o-r),y=o/(o-r);else if(a===ji)m=-2/(o-r),y=-(o+r)/(o-r);else if(a===ua)m=-1/(o-r),y=-r/(o-r);else throw new Error("THREE.Matrix4.makeOrthographic(): Invalid coordinate system: "+a);return c[0]=h,c[4]=0,c[8]=0,c[12]=d,c[1]=0,c[5]=u,c[9]=0,c[13]=f,c[2]=0,c[6]=0,c[10]=m,c[14]=y,c[3]=0,c[7]=0,c[11]=0,c[15]=1,this}equals(t){let e=this.elements,n=t.elements;for(let i=0;i<16;i++)if(e[i]!==n[i])return!1;return!0}fromArray(t,e=0){for(let n=0;n<16;n++)this.elements[n]=t[n+e];return this}toArray(t=[],e=0){let n=this.elements;return t[e]=n[0],t[e+1]=n[1],t[e+2]=n[2],t[e+3]=n[3],t[e+4]=n[4],t[e+5]=n[5],t[e+6]=n[6],t[e+7]=n[7],t[e+8]=n[8],t[e+9]=n[9],t[e+10]=n[10],t[e+11]=n[11],t[e+12]=n[12],t[e+13]=n[13],t[e+14]=n[14],t[e+15]=n[15],t}},qo=new F,ss=new Nt,mT=new F(0,0,0),gT=new F(1,1,1),xr=new F,uh=new F,Ni=new F,t_=new Nt,e_=new We,xi=class s{constructor(t=0,e=0,n=0,i=s.DEFAULT_ORDER){this.isEuler=!0,this._x=t,this._y=e,this._z=n,this._order=i}get x(){return this._x}set x(t){this._x=t,this._onChangeCallback()}get y(){return this._y}set y(t){this._y=t,this._onChangeCallback()}get z(){return this._z}set z(t){this._z=t,this._onChangeCallback()}get order(){return this._order}set order(t){this._order=t,this._onChangeCallback()}set(t,e,n,i=this._order){return this._x=t,this._y=e,this._z=n,this._order=i,this._onChangeCallback(),this}clone(){return new this.constructor(this._x,this._y,this._z,this._order)}copy(t){return this._x=t._x,this._y=t._y,this._z=t._z,this._order=t._order,this._onChangeCallback(),this}setFromRotationMatrix(t,e=this._order,n=!0){let i=t.elements,r=i[0],o=i[4],a=i[8],l=i[1],c=i[5],h=i[9],u=i[2],d=i[6],f=i[10];switch(e){case"XYZ":this._y=Math.asin(le(a,-1,1)),Math.abs(a)<.9999999?(this._x=Math.atan2(-h,f),this._z=Math.atan2(-o,r)):(this._x=Math.atan2(d,c),this._z=0);break;case"YXZ":this._x=Math.asin(-le(h,-1,1)),Math.abs(h)<.9999999?(this._y=Math.atan2(a,f),this._z=Math.atan2(l,c)):(this._y=Math.atan2(-u,r),this._z=0);break;case"ZXY":this._x=Math.asin(le(d,-1,1)),Math.abs(d)<.9999999?(this._y=Math.atan2(-u,f),this._z=Math.atan2(-o,c)):(this._y=0,this._z=Math.atan2(l,r));break;case"ZYX":this._y=Math.asin(-le(u,-1,1)),Math.abs(u)<.9999999?(this._x=Math.atan2(d,f),this._z=Math.atan2(l,r)):(this._x=0,this._z=Math.atan2(-o,c));break;case"YZX":this._z=Math.asin(le(l,-1,1)),Math.abs(l)<.9999999?(this._x=Math.atan2(-h,c),this._y=Math.atan2(-u,r)):(this._x=0,this._y=Math.atan2(a,f));break;case"XZY":this._z=Math.asin(-le(o,-1,1)),Math.abs(o)<.9999999?(this._x=Math.atan2(d,c),this._y=Math.atan2(a,r)):(this._x=Math.atan2(-h,f),this._y=0);break;default:Yt("Euler: .setFromRotationMatrix() encountered an unknown order: "+e)}return this._order=e,n===!0&&this._onChangeCallback(),this}setFromQuaternion(t,e,n){return t_.makeRotationFromQuaternion(t),this.setFromRotationMatrix(t_,e,n)}setFromVector3(t,e=this._order){return this.set(t.x,t.y,t.z,e)}reorder(t){return e_.setFromEuler(this),this.setFromQuaternion(e_,t)}equals(t){return t._x===this._x&&t._y===this._y&&t._z===this._z&&t._order===this._order}fromArray(t){return this._x=t[0],this._y=t[1],this._z=t[2],t[3]!==void 0&&(this._order=t[3]),this._onChangeCallback(),this}toArray(t=[],e=0){return t[e]=this._x,t[e+1]=this._y,t[e+2]=this._z,t[e+3]=this._order,t}_onChange(t){return this._onChangeCallback=t,this}_onChangeCallback(){}*[Symbol.iterator](){yield this._x,yield this._y,yield this._z,yield this._order}};xi.DEFAULT_ORDER="XYZ";var ma=class{constructor(){this.mask=1}set(t){this.mask=(1<<t|0)>>>0}enable(t){this.mask|=1<<t|0}enableAll(){this.mask=-1}toggle(t){this.mask^=1<<t|0}disable(t){this.mask&=~(1<<t|0)}disableAll(){this.mask=0}test(t){return(this.mask&t.mask)!==0}isEnabled(t){return(this.mask&(1<<t|0))!==0}},yT=0,n_=new F,jo=new We,Hs=new Nt,dh=new F,rl=new F,_T=new F,xT=new We,i_=new F(1,0,0),s_=new F(0,1,0),r_=new F(0,0,1),o_={type:"added"},vT={type:"removed"},Yo={type:"childadded",child:null},dp={type:"childremoved",child:null},sn=class s extends ls{constructor(){super(),this.isObject3D=!0,Object.defineProperty(this,"id",{value:yT++}),this.uuid=Rs(),this.name="",this.type="Object3D",this.parent=null,this.children=[],this.up=s.DEFAULT_UP.clone();let t=new F,e=new xi,n=new We,i=new F(1,1,1);function r(){n.setFromEuler(e,!1)}function o(){e.setFromQuaternion(n,void 0,!1)}e._onChange(r),n._onChange(o),Object.defineProperties(this,{position:{configurable:!0,enumerable:!0,value:t},rotation:{configurable:!0,enumerable:!0,value:e},quaternion:{configurable:!0,enumerable:!0,value:n},scale:{configurable:!0,enumerable:!0,value:i},modelViewMatrix:{value:new Nt},normalMatrix:{value:new se}}),this.matrix=new Nt,this.matrixWorld=new Nt,this.matrixAutoUpdate=s.DEFAULT_MATRIX_AUTO_UPDATE,this.matrixWorldAutoUpdate=s.DEFAULT_MATRIX_WORLD_AUTO_UPDATE,this.matrixWorldNeedsUpdate=!1,this.layers=new ma,this.visible=!0,this.castShadow=!1,this.receiveShadow=!1,this.frustumCulled=!0,this.renderOrder=0,this.animations=[],this.customDepthMaterial=void 0,this.customDistanceMaterial=void 0,this.static=!1,this.userData={},this.pivot=null}onBeforeShadow(){}onAfterShadow(){}onBeforeRender(){}onAfterRender(){}applyMatrix4(t){this.matrixAutoUpdate&&this.updateMatrix(),this.matrix.premultiply(t),this.matrix.decompose(this.position,this.quaternion,this.scale),this.pivot!==null&&this.position.copy(this.pivot).applyMatrix4(this.matrix).sub(this.pivot)}applyQuaternion(t){return this.quaternion.premultiply(t),this}setRotationFromAxisAngle(t,e){this.quaternion.setFromAxisAngle(t,e)}setRotationFromEuler(t){this.quaternion.setFromEuler(t,!0)}setRotationFromMatrix(t){this.quaternion.setFromRotationMatrix(t)}setRotationFromQuaternion(t){this.quaternion.copy(t)}rotateOnAxis(t,e){return jo.setFromAxisAngle(t,e),this.quaternion.multiply(jo),this}rotateOnWorldAxis(t,e){return jo.setFromAxisAngle(t,e),this.quaternion.premultiply(jo),this}rotateX(t){return this.rotateOnAxis(i_,t)}rotateY(t){return this.rotateOnAxis(s_,t)}rotateZ(t){return this.rotateOnAxis(r_,t)}translateOnAxis(t,e){return n_.copy(t).applyQuaternion(this.quaternion),this.position.add(n_.multiplyScalar(e)),this}translateX(t){return this.translateOnAxis(i_,t)}translateY(t){return this.translateOnAxis(s_,t)}translateZ(t){return this.translateOnAxis(r_,t)}localToWorld(t){return this.updateWorldMatrix(!0,!1),t.applyMatrix4(this.matrixWorld)}worldToLocal(t){return this.updateWorldMatrix(!0,!1),t.applyMatrix4(Hs.copy(this.matrixWorld).invert())}lookAt(t,e,n){t.isVector3?dh.copy(t):dh.set(t,e,n);let i=this.parent;this.updateWorldMatrix(!0,!1),rl.setFromMatrixPosition(this.matrixWorld),this.isCamera||this.isLight?Hs.lookAt(rl,dh,this.up):Hs.lookAt(dh,rl,this.up),this.quaternion.setFromRotationMatrix(Hs),i&&(Hs.extractRotation(i.matrixWorld),jo.setFromRotationMatrix(Hs),this.quaternion.premultiply(jo.invert()))}add(t){if(arguments.length>1){for(let e=0;e<arguments.length;e++)this.add(arguments[e]);return this}return t===this?(te("Object3D.add: object can't be added as a child of itself.",t),this):(t&&t.isObject3D?(t.removeFromParent(),t.parent=this,this.children.push(t),t.dispatchEvent(o_),Yo.child=t,this.dispatchEvent(Yo),Yo.child=null):te("Object3D.add: object not an instance of THREE.Object3D.",t),this)}remove(t){if(arguments.length>1){for(let n=0;n<arguments.length;n++)this.remove(arguments[n]);return this}let e=this.children.indexOf(t);return e!==-1&&(t.parent=null,this.children.splice(e,1),t.dispatchEvent(vT),dp.child=t,this.dispatchEvent(dp),dp.child=null),this}removeFromParent(){let t=this.parent;return t!==null&&t.remove(this),this}clear(){return this.remove(...this.children)}attach(t){return this.updateWorldMatrix(!0,!1),Hs.copy(this.matrixWorld).invert(),t.parent!==null&&(t.parent.updateWorldMatrix(!0,!1),Hs.multiply(t.parent.matrixWorld)),t.applyMatrix4(Hs),t.removeFromParent(),t.parent=this,this.children.push(t),t.updateWorldMatrix(!1,!0),t.dispatchEvent(o_),Yo.child=t,this.dispatchEvent(Yo),Yo.child=null,this}getObjectById(t){return this.getObjectByProperty("id",t)}getObjectByName(t){return this.getObjectByProperty("name",t)}getObjectByProperty(t,e){if(this[t]===e)return this;for(let n=0,i=this.children.length;n<i;n++){let o=this.children[n].getObjectByProperty(t,e);if(o!==void 0)return o}}getObjectsByProperty(t,e,n=[]){this[t]===e&&n.push(this);let i=this.children;for(let r=0,o=i.length;r<o;r++)i[r].getObjectsByProperty(t,e,n);return n}getWorldPosition(t){return this.updateWorldMatrix(!0,!1),t.setFromMatrixPosition(this.matrixWorld)}getWorldQuaternion(t){return this.updateWorldMatrix(!0,!1),this.matrixWorld.decompose(rl,t,_T),t}getWorldScale(t){return this.updateWorldMatrix(!0,!1),this.matrixWorld.decompose(rl,xT,t),t}getWorldDirection(t){this.updateWorldMatrix(!0,!1);let e=this.matrixWorld.elements;return t.set(e[8],e[9],e[10]).normalize()}raycast(){}intersectsFrustum(){return!0}traverse(t){t(this);let e=this.children;for(let n=0,i=e.length;n<i;n++)e[n].traverse(t)}traverseVisible(t){if(this.visible===!1)return;t(this);let e=this.children;for(let n=0,i=e.length;n<i;n++)e[n].traverseVisible(t)}traverseAncestors(t){let e=this.parent;e!==null&&(t(e),e.traverseAncestors(t))}updateMatrix(){this.matrix.compose(this.position,this.quaternion,this.scale);let t=this.pivot;if(t!==null){let e=t.x,n=t.y,i=t.z,r=this.matrix.elements;r[12]+=e-r[0]*e-r[4]*n-r[8]*i,r[13]+=n-r[1]*e-r[5]*n-r[9]*i,r[14]+=i-r[2]*e-r[6]*n-r[10]*i}this.matrixWorldNeedsUpdate=!0}updateMatrixWorld(t){this.matrixAutoUpdate&&this.updateMatrix(),(this.matrixWorldNeedsUpdate||t)&&(this.matrixWorldAutoUpdate===!0&&(this.parent===null?this.matrixWorld.copy(this.matrix):this.matrixWorld.multiplyMatrices(this.parent.matrixWorld,this.matrix)),this.matrixWorldNeedsUpdate=!1,t=!0);let e=this.children;for(let n=0,i=e.length;n<i;n++)e[n].updateMatrixWorld(t)}updateWorldMatrix(t,e,n=!1){let i=this.parent;if(t===!0&&i!==null&&i.updateWorldMatrix(!0,!1),this.matrixAutoUpdate&&this.updateMatrix(),(this.matrixWorldNeedsUpdate||n)&&(this.matrixWorldAutoUpdate===!0&&(this.parent===null?this.matrixWorld.copy(this.matrix):this.matrixWorld.multiplyMatrices(this.parent.matrixWorld,this.matrix)),this.matrixWorldNeedsUpdate=!1,n=!0),e===!0){let r=this.children;for(let o=0,a=r.length;o<a;o++)r[o].updateWorldMatrix(!1,!0,n)}}toJSON(t){let e=t===void 0||typeof t=="string",n={};e&&(t={geometries:{},materials:{},textures:{},images:{},shapes:{},skeletons:{},animations:{},nodes:{}},n.metadata={version:4.7,type:"Object",generator:"Object3D.toJSON"});let i={};i.uuid=this.uuid,i.type=this.type,i.name=this.name,i.castShadow=this.castShadow,i.receiveShadow=this.receiveShadow,i.visible=this.visible,i.frustumCulled=this.frustumCulled,i.renderOrder=this.renderOrder,i.static=this.static,i.matrixAutoUpdate=this.matrixAutoUpdate,Object.keys(this.userData).length>0&&(i.userData=this.userData),i.layers=this.layers.mask,i.matrix=this.matrix.toArray(),i.up=this.up.toArray(),this.pivot!==null&&(i.pivot=this.pivot.toArray()),this.morphTargetDictionary!==void 0&&(i.morphTargetDictionary=Object.assign({},this.morphTargetDictionary)),this.morphTargetInfluences!==void 0&&(i.morphTargetInfluences=this.morphTargetInfluences.slice()),this.isInstancedMesh&&(i.type="InstancedMesh",i.count=this.count,i.instanceMatrix=this.instanceMatrix.toJSON(),this.instanceColor!==null&&(i.instanceColor=this.instanceColor.toJSON())),this.isBatchedMesh&&(i.type="BatchedMesh",i.perObjectFrustumCulled=this.perObjectFrustumCulled,i.sortObjects=this.sortObjects,i.drawRanges=this._drawRanges,i.reservedRanges=this._reservedRanges,i.geometryInfo=this._geometryInfo.map(a=>({...a,boundingBox:a.boundingBox?a.boundingBox.toJSON():void 0,boundingSphere:a.boundingSphere?a.boundingSphere.toJSON():void 0})),i.instanceInfo=this._instanceInfo.map(a=>({...a})),i.availableInstanceIds=this._availableInstanceIds.slice(),i.availableGeometryIds=this._availableGeometryIds.slice(),i.nextIndexStart=this._nextIndexStart,i.nextVertexStart=this._nextVertexStart,i.geometryCount=this._geometryCount,i.maxInstanceCount=this._maxInstanceCount,i.maxVertexCount=this._maxVertexCount,i.maxIndexCount=this._maxIndexCount,i.geometryInitialized=this._geometryInitialized,i.matricesTexture=this._matricesTexture.toJSON(t),i.indirectTexture=this._indirectTexture.toJSON(t),this._colorsTexture!==null&&(i.colorsTexture=this._colorsTexture.toJSON(t)),this.boundingSphere!==null&&(i.boundingSphere=this.boundingSphere.toJSON()),this.boundingBox!==null&&(i.boundingBox=this.boundingBox.toJSON()));function r(a,l){return a[l.uuid]===void 0&&(a[l.uuid]=l.toJSON(t)),l.uuid}if(this.isScene)this.background&&(this.background.isColor?i.background=this.background.toJSON():this.background.isTexture&&(i.background=this.background.toJSON(t).uuid)),this.environment&&this.environment.isTexture&&this.environment.isRenderTargetTexture!==!0&&(i.environment=this.environment.toJSON(t).uuid);else if(this.isMesh||this.isLine||this.isPoints){i.geometry=r(t.geometries,this.geometry);let a=this.geometry.parameters;if(a!==void 0&&a.shapes!==void 0){let l=a.shapes;if(Array.isArray(l))for(let c=0,h=l.length;c<h;c++){let u=l[c];r(t.shapes,u)}else r(t.shapes,l)}}if(this.isSkinnedMesh&&(i.bindMode=this.bindMode,i.bindMatrix=this.bindMatrix.toArray(),this.skeleton!==void 0&&(r(t.skeletons,this.skeleton),i.skeleton=this.skeleton.uuid)),this.material!==void 0)if(Array.isArray(this.material)){let a=[];for(let l=0,c=this.material.length;l<c;l++)a.push(r(t.materials,this.material[l]));i.material=a}else i.material=r(t.materials,this.material);if(this.children.length>0){i.children=[];for(let a=0;a<this.children.length;a++)i.children.push(this.children[a].toJSON(t).object)}if(this.animations.length>0){i.animations=[];for(let a=0;a<this.animations.length;a++){let l=this.animations[a];i.animations.push(r(t.animations,l))}}if(e){let a=o(t.geometries),l=o(t.materials),c=o(t.textures),h=o(t.images),u=o(t.shapes),d=o(t.skeletons),f=o(t.animations),m=o(t.nodes);a.length>0&&(n.geometries=a),l.length>0&&(n.materials=l),c.length>0&&(n.textures=c),h.length>0&&(n.images=h),u.length>0&&(n.shapes=u),d.length>0&&(n.skeletons=d),f.length>0&&(n.animations=f),m.length>0&&(n.nodes=m)}return n.object=i,n;function o(a){let l=[];for(let c in a){let h=a[c];delete h.metadata,l.push(h)}return l}}clone(t){return new this.constructor().copy(this,t)}copy(t,e=!0){if(this.name=t.name,this.up.copy(t.up),this.position.copy(t.position),this.rotation.order=t.rotation.order,this.quaternion.copy(t.quaternion),this.scale.copy(t.scale),this.pivot=t.pivot!==null?t.pivot.clone():null,this.matrix.copy(t.matrix),this.matrixWorld.copy(t.matrixWorld),this.matrixAutoUpdate=t.matrixAutoUpdate,this.matrixWorldAutoUpdate=t.matrixWorldAutoUpdate,this.matrixWorldNeedsUpdate=t.matrixWorldNeedsUpdate,this.layers.mask=t.layers.mask,this.visible=t.visible,this.castShadow=t.castShadow,this.receiveShadow=t.receiveShadow,this.frustumCulled=t.frustumCulled,this.renderOrder=t.renderOrder,this.static=t.static,this.animations=t.animations.slice(),this.userData=JSON.parse(JSON.stringify(t.userData)),e===!0)for(let n=0;n<t.children.length;n++){let i=t.children[n];this.add(i.clone())}return this}dispose(){this.dispatchEvent({type:"dispose"})}};sn.DEFAULT_UP=new F(0,1,0);sn.DEFAULT_MATRIX_AUTO_UPDATE=!0;sn.DEFAULT_MATRIX_WORLD_AUTO_UPDATE=!0;var Ge=class extends sn{constructor(){super(),this.isGroup=!0,this.type="Group"}},bT={type:"move"},ga=class{constructor(){this._targetRay=null,this._grip=null,this._hand=null}getHandSpace(){return this._hand===null&&(this._hand=new Ge,this._hand.matrixAutoUpdate=!1,this._hand.visible=!1,this._hand.joints={},this._hand.inputState={pinching:!1}),this._hand}getTargetRaySpace(){return this._targetRay===null&&(this._targetRay=new Ge,this._targetRay.matrixAutoUpdate=!1,this._targetRay.visible=!1,this._targetRay.hasLinearVelocity=!1,this._targetRay.linearVelocity=new F,this._targetRay.hasAngularVelocity=!1,this._targetRay.angularVelocity=new F),this._targetRay}getGripSpace(){return this._grip===null&&(this._grip=new Ge,this._grip.matrixAutoUpdate=!1,this._grip.visible=!1,this._grip.hasLinearVelocity=!1,this._grip.linearVelocity=new F,this._grip.hasAngularVelocity=!1,this._grip.angularVelocity=new F,this._grip.eventsEnabled=!1),this._grip}dispatchEvent(t){return this._targetRay!==null&&this._targetRay.dispatchEvent(t),this._grip!==null&&this._grip.dispatchEvent(t),this._hand!==null&&this._hand.dispatchEvent(t),this}connect(t){if(t&&t.hand){let e=this._hand;if(e)for(let n of t.hand.values())this._getHandJoint(e,n)}return this.dispatchEvent({type:"connected",data:t}),this}disconnect(t){return this.dispatchEvent({type:"disconnected",data:t}),this._targetRay!==null&&(this._targetRay.visible=!1),this._grip!==null&&(this._grip.visible=!1),this._hand!==null&&(this._hand.visible=!1),this}update(t,e,n){let i=null,r=null,o=null,a=this._targetRay,l=this._grip,c=this._hand;if(t&&e.session.visibilityState!=="visible-blurred"){if(c&&t.hand){o=!0;for(let y of t.hand.values()){let p=e.getJointPose(y,n),g=this._getHandJoint(c,y);p!==null&&(g.matrix.fromArray(p.transform.matrix),g.matrix.decompose(g.position,g.quaternion,g.scale),g.matrixWorldNeedsUpdate=!0,g.jointRadius=p.radius),g.visible=p!==null}let h=c.joints["index-finger-tip"],u=c.joints["thumb-tip"],d=h.position.distanceTo(u.position),f=.02,m=.005;c.inputState.pinching&&d>f+m?(c.inputState.pinching=!1,this.dispatchEvent({type:"pinchend",handedness:t.handedness,target:this})):!c.inputState.pinching&&d<=f-m&&(c.inputState.pinching=!0,this.dispatchEvent({type:"pinchstart",handedness:t.handedness,target:this}))}else l!==null&&t.gripSpace&&(r=e.getPose(t.gripSpace,n),r!==null&&(l.matrix.fromArray(r.transform.matrix),l.matrix.decompose(l.position,l.quaternion,l.scale),l.matrixWorldNeedsUpdate=!0,r.linearVelocity?(l.hasLinearVelocity=!0,l.linearVelocity.copy(r.linearVelocity)):l.hasLinearVelocity=!1,r.angularVelocity?(l.hasAngularVelocity=!0,l.angularVelocity.copy(r.angularVelocity)):l.hasAngularVelocity=!1,l.eventsEnabled&&l.dispatchEvent({type:"gripUpdated",data:t,target:this})));a!==null&&(i=e.getPose(t.targetRaySpace,n),i===null&&r!==null&&(i=r),i!==null&&(a.matrix.fromArray(i.transform.matrix),a.matrix.decompose(a.position,a.quaternion,a.scale),a.matrixWorldNeedsUpdate=!0,i.linearVelocity?(a.hasLinearVelocity=!0,a.linearVelocity.copy(i.linearVelocity)):a.hasLinearVelocity=!1,i.angularVelocity?(a.hasAngularVelocity=!0,a.angularVelocity.copy(i.angularVelocity)):a.hasAngularVelocity=!1,this.dispatchEvent(bT)))}return a!==null&&(a.visible=i!==null),l!==null&&(l.visible=r!==null),c!==null&&(c.visible=o!==null),this}_getHandJoint(t,e){if(t.joints[e.jointName]===void 0){let n=new Ge;n.matrixAutoUpdate=!1,n.visible=!1,t.joints[e.jointName]=n,t.add(n)}return t.joints[e.jointName]}},Ax={aliceblue:15792383,antiquewhite:16444375,aqua:65535,aquamarine:8388564,azure:15794175,beige:16119260,bisque:16770244,black:0,blanchedalmond:16772045,blue:255,blueviolet:9055202,brown:10824234,burlywood:14596231,cadetblue:6266528,chartreuse:8388352,chocolate:13789470,coral:16744272,cornflowerblue:6591981,cornsilk:16775388,crimson:14423100,cyan:65535,darkblue:139,darkcyan:35723,darkgoldenrod:12092939,darkgray:11119017,darkgreen:25600,darkgrey:11119017,darkkhaki:12433259,darkmagenta:9109643,darkolivegreen:5597999,darkorange:16747520,darkorchid:10040012,darkred:9109504,darksalmon:15308410,darkseagreen:9419919,darkslateblue:4734347,darkslategray:3100495,darkslategrey:3100495,darkturquoise:52945,darkviolet:9699539,deeppink:16716947,deepskyblue:49151,dimgray:6908265,dimgrey:6908265,dodgerblue:2003199,firebrick:11674146,floralwhite:16775920,forestgreen:2263842,fuchsia:16711935,gainsboro:14474460,ghostwhite:16316671,gold:16766720,goldenrod:14329120,gray:8421504,green:32768,greenyellow:11403055,grey:8421504,honeydew:15794160,hotpink:16738740,indianred:13458524,indigo:4915330,ivory:16777200,khaki:15787660,lavender:15132410,lavenderblush:16773365,lawngreen:8190976,lemonchiffon:16775885,lightblue:11393254,lightcoral:15761536,lightcyan:14745599,lightgoldenrodyellow:16448210,lightgray:13882323,lightgreen:9498256,lightgrey:13882323,lightpink:16758465,lightsalmon:16752762,lightseagreen:2142890,lightskyblue:8900346,lightslategray:7833753,lightslategrey:7833753,lightsteelblue:11584734,lightyellow:16777184,lime:65280,limegreen:3329330,linen:16445670,magenta:16711935,maroon:8388608,mediumaquamarine:6737322,mediumblue:205,mediumorchid:12211667,mediumpurple:9662683,mediumseagreen:3978097,mediumslateblue:8087790,mediumspringgreen:64154,mediumturquoise:4772300,mediumvioletred:13047173,midnightblue:1644912,mintcream:16121850,mistyrose:16770273,moccasin:16770229,navajowhite:16768685,navy:128,oldlace:16643558,olive:8421376,olivedrab:7048739,orange:16753920,orangered:16729344,orchid:14315734,palegoldenrod:15657130,palegreen:10025880,paleturquoise:11529966,palevioletred:14381203,papayawhip:16773077,peachpuff:16767673,peru:13468991,pink:16761035,plum:14524637,powderblue:11591910,purple:8388736,rebeccapurple:6697881,red:16711680,rosybrown:12357519,royalblue:4286945,saddlebrown:9127187,salmon:16416882,sandybrown:16032864,seagreen:3050327,seashell:16774638,sienna:10506797,silver:12632256,skyblue:8900331,slateblue:6970061,slategray:7372944,slategrey:7372944,snow:16775930,springgreen:65407,steelblue:4620980,tan:13808780,teal:32896,thistle:14204888,tomato:16737095,turquoise:4251856,violet:15631086,wheat:16113331,white:16777215,whitesmoke:16119285,yellow:16776960,yellowgreen:10145074},vr={h:0,s:0,l:0},fh={h:0,s:0,l:0};function fp(s,t,e){return e<0&&(e+=1),e>1&&(e-=1),e<1/6?s+(t-s)*6*e:e<1/2?t:e<2/3?s+(t-s)*6*(2/3-e):s}var Rt=class{constructor(t,e,n){return this.isColor=!0,this.r=1,this.g=1,this.b=1,this.set(t,e,n)}set(t,e,n){if(e===void 0&&n===void 0){let i=t;i&&i.isColor?this.copy(i):typeof i=="number"?this.setHex(i):typeof i=="string"&&this.setStyle(i)}else this.setRGB(t,e,n);return this}setScalar(t){return this.r=t,this.g=t,this.b=t,this}setHex(t,e=Te){return t=Math.floor(t),this.r=(t>>16&255)/255,this.g=(t>>8&255)/255,this.b=(t&255)/255,ue.colorSpaceToWorking(this,e),this}setRGB(t,e,n,i=ue.workingColorSpace){return this.r=t,this.g=e,this.b=n,ue.colorSpaceToWorking(this,i),this}setHSL(t,e,n,i=ue.workingColorSpace){if(t=vm(t,1),e=le(e,0,1),n=le(n,0,1),e===0)this.r=this.g=this.b=n;else{let r=n<=.5?n*(1+e):n+e-n*e,o=2*n-r;this.r=fp(o,r,t+1/3),this.g=fp(o,r,t),this.b=fp(o,r,t-1/3)}return ue.colorSpaceToWorking(this,i),this}setStyle(t,e=Te){function n(r){r!==void 0&&parseFloat(r)<1&&Yt("Color: Alpha component of "+t+" will be ignored.")}let i;if(i=/^(\w+)\(([^\)]*)\)/.exec(t)){let r,o=i[1],a=i[2];switch(o){case"rgb":case"rgba":if(r=/^\s*(\d+)\s*,\s*(\d+)\s*,\s*(\d+)\s*(?:,\s*(\d+(?:\.\d+)?|\.\d+)\s*)?$/.exec(a))return n(r[4]),this.setRGB(Math.min(255,parseInt(r[1],10))/255,Math.min(255,parseInt(r[2],10))/255,Math.min(255,parseInt(r[3],10))/255,e);if(r=/^\s*(\d+(?:\.\d+)?|\.\d+)\%\s*,\s*(\d+(?:\.\d+)?|\.\d+)\%\s*,\s*(\d+(?:\.\d+)?|\.\d+)\%\s*(?:,\s*(\d+(?:\.\d+)?|\.\d+)\s*)?$/.exec(a))return n(r[4]),this.setRGB(Math.min(100,parseFloat(r[1]))/100,Math.min(100,parseFloat(r[2]))/100,Math.min(100,parseFloat(r[3]))/100,e);break;case"hsl":case"hsla":if(r=/^\s*([+-]?(?:\d+(?:\.\d+)?|\.\d+))\s*,\s*(\d+(?:\.\d+)?|\.\d+)\%\s*,\s*(\d+(?:\.\d+)?|\.\d+)\%\s*(?:,\s*(\d+(?:\.\d+)?|\.\d+)\s*)?$/.exec(a))return n(r[4]),this.setHSL(parseFloat(r[1])/360,parseFloat(r[2])/100,parseFloat(r[3])/100,e);break;default:Yt("Color: Unknown color model "+t)}}else if(i=/^\#([A-Fa-f\d]+)$/.exec(t)){let r=i[1],o=r.length;if(o===3)return this.setRGB(parseInt(r.charAt(0),16)/15,parseInt(r.charAt(1),16)/15,parseInt(r.charAt(2),16)/15,e);if(o===6)return this.setHex(parseInt(r,16),e);Yt("Color: Invalid hex color "+t)}else if(t&&t.length>0)return this.setColorName(t,e);return this}setColorName(t,e=Te){let n=Ax[t.toLowerCase()];return n!==void 0?this.setHex(n,e):Yt("Color: Unknown color "+t),this}clone(){return new this.constructor(this.r,this.g,this.b)}copy(t){return this.r=t.r,this.g=t.g,this.b=t.b,this}copySRGBToLinear(t){return this.r=$s(t.r),this.g=$s(t.g),this.b=$s(t.b),this}copyLinearToSRGB(t){return this.r=la(t.r),this.g=la(t.g),this.b=la(t.b),this}convertSRGBToLinear(){return this.copySRGBToLinear(this),this}convertLinearToSRGB(){return this.copyLinearToSRGB(this),this}getHex(t=Te){return ue.workingToColorSpace(ti.copy(this),t),Math.round(le(ti.r*255,0,255))*65536+Math.round(le(ti.g*255,0,255))*256+Math.round(le(ti.b*255,0,255))}getHexString(t=Te){return("000000"+this.getHex(t).toString(16)).slice(-6)}getHSL(t,e=ue.workingColorSpace){ue.workingToColorSpace(ti.copy(this),e);let n=ti.r,i=ti.g,r=ti.b,o=Math.max(n,i,r),a=Math.min(n,i,r),l,c,h=(a+o)/2;if(a===o)l=0,c=0;else{let u=o-a;switch(c=h<=.5?u/(o+a):u/(2-o-a),o){case n:l=(i-r)/u+(i<r?6:0);break;case i:l=(r-n)/u+2;break;case r:l=(n-i)/u+4;break}l/=6}return t.h=l,t.s=c,t.l=h,t}getRGB(t,e=ue.workingColorSpace){return ue.workingToColorSpace(ti.copy(this),e),t.r=ti.r,t.g=ti.g,t.b=ti.b,t}getStyle(t=Te){ue.workingToColorSpace(ti.copy(this),t);let e=ti.r,n=ti.g,i=ti.b;return t!==Te?`color(${t} ${e.toFixed(3)} ${n.toFixed(3)} ${i.toFixed(3)})`:`rgb(${Math.round(e*255)},${Math.round(n*255)},${Math.round(i*255)})`}offsetHSL(t,e,n){return this.getHSL(vr),this.setHSL(vr.h+t,vr.s+e,vr.l+n)}add(t){return this.r+=t.r,this.g+=t.g,this.b+=t.b,this}addColors(t,e){return this.r=t.r+e.r,this.g=t.g+e.g,this.b=t.b+e.b,this}addScalar(t){return this.r+=t,this.g+=t,this.b+=t,this}sub(t){return this.r=Math.max(0,this.r-t.r),this.g=Math.max(0,this.g-t.g),this.b=Math.max(0,this.b-t.b),this}multiply(t){return this.r*=t.r,this.g*=t.g,this.b*=t.b,this}multiplyScalar(t){return this.r*=t,this.g*=t,this.b*=t,this}lerp(t,e){return this.r+=(t.r-this.r)*e,this.g+=(t.g-this.g)*e,this.b+=(t.b-this.b)*e,this}lerpColors(t,e,n){return this.r=t.r+(e.r-t.r)*n,this.g=t.g+(e.g-t.g)*n,this.b=t.b+(e.b-t.b)*n,this}lerpHSL(t,e){this.getHSL(vr),t.getHSL(fh);let n=gl(vr.h,fh.h,e),i=gl(vr.s,fh.s,e),r=gl(vr.l,fh.l,e);return this.setHSL(n,i,r),this}setFromVector3(t){return this.r=t.x,this.g=t.y,this.b=t.z,this}applyMatrix3(t){let e=this.r,n=this.g,i=this.b,r=t.elements;return this.r=r[0]*e+r[3]*n+r[6]*i,this.g=r[1]*e+r[4]*n+r[7]*i,this.b=r[2]*e+r[5]*n+r[8]*i,this}equals(t){return t.r===this.r&&t.g===this.g&&t.b===this.b}fromArray(t,e=0){return this.r=t[e],this.g=t[e+1],this.b=t[e+2],this}toArray(t=[],e=0){return t[e]=this.r,t[e+1]=this.g,t[e+2]=this.b,t}fromBufferAttribute(t,e){return this.r=t.getX(e),this.g=t.getY(e),this.b=t.getZ(e),this}toJSON(){return this.getHex()}*[Symbol.iterator](){yield this.r,yield this.g,yield this.b}},ti=new Rt;Rt.NAMES=Ax;var Sl=class s{constructor(t,e=1,n=1e3){this.isFog=!0,this.name="",this.color=new Rt(t),this.near=e,this.far=n}clone(){return new s(this.color,this.near,this.far)}toJSON(){return{type:"Fog",name:this.name,color:this.color.getHex(),near:this.near,far:this.far}}},Tr=class extends sn{constructor(){super(),this.isScene=!0,this.type="Scene",this.background=null,this.environment=null,this.fog=null,this.backgroundBlurriness=0,this.backgroundIntensity=1,this.backgroundRotation=new xi,this.environmentIntensity=1,this.environmentRotation=new xi,this.overrideMaterial=null,typeof __THREE_DEVTOOLS__<"u"&&__THREE_DEVTOOLS__.dispatchEvent(new CustomEvent("observe",{detail:this}))}copy(t,e){return super.copy(t,e),this.background=t.background!==null?t.background.clone():null,this.environment=t.environment!==null?t.environment.clone():null,this.fog=t.fog!==null?t.fog.clone():null,this.backgroundBlurriness=t.backgroundBlurriness,this.backgroundIntensity=t.backgroundIntensity,this.backgroundRotation.copy(t.backgroundRotation),this.environmentIntensity=t.environmentIntensity,this.environmentRotation.copy(t.environmentRotation),this.overrideMaterial=t.overrideMaterial!==null?t.overrideMaterial.clone():null,this.matrixAutoUpdate=t.matrixAutoUpdate,this}toJSON(t){let e=super.toJSON(t);return this.fog!==null&&(e.object.fog=this.fog.toJSON()),e.object.backgroundBlurriness=this.backgroundBlurriness,e.object.backgroundIntensity=this.backgroundIntensity,e.object.backgroundRotation=this.backgroundRotation.toArray(),e.object.environmentIntensity=this.environmentIntensity,e.object.environmentRotation=this.environmentRotation.toArray(),e}},rs=new F,Ws=new F,pp=new F,Xs=new F,$o=new F,Jo=new F,a_=new F,mp=new F,gp=new F,yp=new F,_p=new Se,xp=new Se,vp=new Se,as=class s{constructor(t=new F,e=new F,n=new F){this.a=t,this.b=e,this.c=n}static getNormal(t,e,n,i){i.subVectors(n,e),rs.subVectors(t,e),i.cross(rs);let r=i.lengthSq();return r>0?i.multiplyScalar(1/Math.sqrt(r)):i.set(0,0,0)}static getBarycoord(t,e,n,i,r){rs.subVectors(i,e),Ws.subVectors(n,e),pp.subVectors(t,e);let o=rs.dot(rs),a=rs.dot(Ws),l=rs.dot(pp),c=Ws.dot(Ws),h=Ws.dot(pp),u=o*c-a*a;if(u===0)return r.set(0,0,0),null;let d=1/u,f=(c*l-a*h)*d,m=(o*h-a*l)*d;return r.set(1-f-m,m,f)}static containsPoint(t,e,n,i){return this.getBarycoord(t,e,n,i,Xs)===null?!1:Xs.x>=0&&Xs.y>=0&&Xs.x+Xs.y<=1}static getInterpolation(t,e,n,i,r,o,a,l){return this.getBarycoord(t,e,n,i,Xs)===null?(l.x=0,l.y=0,"z"in l&&(l.z=0),"w"in l&&(l.w=0),null):(l.setScalar(0),l.addScaledVector(r,Xs.x),l.addScaledVector(o,Xs.y),l.addScaledVector(a,Xs.z),l)}static getInterpolatedAttribute(t,e,n,i,r,o){return _p.setScalar(0),xp.setScalar(0),vp.setScalar(0),_p.fromBufferAttribute(t,e),xp.fromBufferAttribute(t,n),vp.fromBufferAttribute(t,i),o.setScalar(0),o.addScaledVector(_p,r.x),o.addScaledVector(xp,r.y),o.addScaledVector(vp,r.z),o}static isFrontFacing(t,e,n,i){return rs.subVectors(n,e),Ws.subVectors(t,e),rs.cross(Ws).dot(i)<0}set(t,e,n){return this.a.copy(t),this.b.copy(e),this.c.copy(n),this}setFromPointsAndIndices(t,e,n,i){return this.a.copy(t[e]),this.b.copy(t[n]),this.c.copy(t[i]),this}setFromAttributeAndIndices(t,e,n,i){return this.a.fromBufferAttribute(t,e),this.b.fromBufferAttribute(t,n),this.c.fromBufferAttribute(t,i),this}clone(){return new this.constructor().copy(this)}copy(t){return this.a.copy(t.a),this.b.copy(t.b),this.c.copy(t.c),this}getArea(){return rs.subVectors(this.c,this.b),Ws.subVectors(this.a,this.b),rs.cross(Ws).length()*.5}getMidpoint(t){return t.addVectors(this.a,this.b).add(this.c).multiplyScalar(1/3)}getNormal(t){return s.getNormal(this.a,this.b,this.c,t)}getPlane(t){return t.setFromCoplanarPoints(this.a,this.b,this.c)}getBarycoord(t,e){return s.getBarycoord(t,this.a,this.b,this.c,e)}getInterpolation(t,e,n,i,r){return s.getInterpolation(t,this.a,this.b,this.c,e,n,i,r)}containsPoint(t){return s.containsPoint(t,this.a,this.b,this.c)}isFrontFacing(t){return s.isFrontFacing(this.a,this.b,this.c,t)}intersectsBox(t){return t.intersectsTriangle(this)}closestPointToPoint(t,e){let n=this.a,i=this.b,r=this.c,o,a;$o.subVectors(i,n),Jo.subVectors(r,n),mp.subVectors(t,n);let l=$o.dot(mp),c=Jo.dot(mp);if(l<=0&&c<=0)return e.copy(n);gp.subVectors(t,i);let h=$o.dot(gp),u=Jo.dot(gp);if(h>=0&&u<=h)return e.copy(i);let d=l*u-h*c;if(d<=0&&l>=0&&h<=0&&l-h>0)return o=l/(l-h),e.copy(n).addScaledVector($o,o);yp.subVectors(t,r);let f=$o.dot(yp),m=Jo.dot(yp);if(m>=0&&f<=m)return e.copy(r);let y=f*c-l*m;if(y<=0&&c>=0&&m<=0)return a=c/(c-m),e.copy(n).addScaledVector(Jo,a);let p=h*m-f*u;if(p<=0&&u-h>=0&&f-m>=0)return a_.subVectors(r,i),a=(u-h)/(u-h+(f-m)),e.copy(i).addScaledVector(a_,a);let g=1/(p+y+d);return o=y*g,a=d*g,e.copy(n).addScaledVector($o,o).addScaledVector(Jo,a)}equals(t){return t.a.equals(this.a)&&t.b.equals(this.b)&&t.c.equals(this.c)}},fn=class{constructor(t=new F(1/0,1/0,1/0),e=new F(-1/0,-1/0,-1/0)){this.isBox3=!0,this.min=t,this.max=e}set(t,e){return this.min.copy(t),this.max.copy(e),this}setFromArray(t){this.makeEmpty();for(let e=0,n=t.length;e<n;e+=3)this.expandByPoint(os.fromArray(t,e));return this}setFromBufferAttribute(t){this.makeEmpty();for(let e=0,n=t.count;e<n;e++)this.expandByPoint(os.fromBufferAttribute(t,e));return this}setFromPoints(t){this.makeEmpty();for(let e=0,n=t.length;e<n;e++)this.expandByPoint(t[e]);return this}setFromCenterAndSize(t,e){let n=os.copy(e).multiplyScalar(.5);return this.min.copy(t).sub(n),this.max.copy(t).add(n),this}setFromObject(t,e=!1){return this.makeEmpty(),this.expandByObject(t,e)}clone(){return new this.constructor().copy(this)}copy(t){return this.min.copy(t.min),this.max.copy(t.max),this}makeEmpty(){return this.min.x=this.min.y=this.min.z=1/0,this.max.x=this.max.y=this.max.z=-1/0,this}isEmpty(){return this.max.x<this.min.x||this.max.y<this.min.y||this.max.z<this.min.z}getCenter(t){return this.isEmpty()?t.set(0,0,0):t.addVectors(this.min,this.max).multiplyScalar(.5)}getSize(t){return this.isEmpty()?t.set(0,0,0):t.subVectors(this.max,this.min)}expandByPoint(t){return this.min.min(t),this.max.max(t),this}expandByVector(t){return this.min.sub(t),this.max.add(t),this}expandByScalar(t){return this.min.addScalar(-t),this.max.addScalar(t),this}expandByObject(t,e=!1){t.updateWorldMatrix(!1,!1);let n=t.geometry;if(n!==void 0){let r=n.getAttribute("position");if(e===!0&&r!==void 0&&t.isInstancedMesh!==!0&&t.isBatchedMesh!==!0)for(let o=0,a=r.count;o<a;o++)t.isMesh===!0?t.getVertexPosition(o,os):os.fromBufferAttribute(r,o),os.applyMatrix4(t.matrixWorld),this.expandByPoint(os);else t.boundingBox!==void 0?(t.boundingBox===null&&t.computeBoundingBox(),ph.copy(t.boundingBox)):(n.boundingBox===null&&n.computeBoundingBox(),ph.copy(n.boundingBox)),ph.applyMatrix4(t.matrixWorld),this.union(ph)}let i=t.children;for(let r=0,o=i.length;r<o;r++)this.expandByObject(i[r],e);return this}containsPoint(t){return t.x>=this.min.x&&t.x<=this.max.x&&t.y>=this.min.y&&t.y<=this.max.y&&t.z>=this.min.z&&t.z<=this.max.z}containsBox(t){return this.min.x<=t.min.x&&t.max.x<=this.max.x&&this.min.y<=t.min.y&&t.max.y<=this.max.y&&this.min.z<=t.min.z&&t.max.z<=this.max.z}getParameter(t,e){return e.set((t.x-this.min.x)/(this.max.x-this.min.x),(t.y-this.min.y)/(this.max.y-this.min.y),(t.z-this.min.z)/(this.max.z-this.min.z))}intersectsBox(t){return t.max.x>=this.min.x&&t.min.x<=this.max.x&&t.max.y>=this.min.y&&t.min.y<=this.max.y&&t.max.z>=this.min.z&&t.min.z<=this.max.z}intersectsSphere(t){return this.clampPoint(t.center,os),os.distanceToSquared(t.center)<=t.radius*t.radius}intersectsPlane(t){let e,n;return t.normal.x>0?(e=t.normal.x*this.min.x,n=t.normal.x*this.max.x):(e=t.normal.x*this.max.x,n=t.normal.x*this.min.x),t.normal.y>0?(e+=t.normal.y*this.min.y,n+=t.normal.y*this.max.y):(e+=t.normal.y*this.max.y,n+=t.normal.y*this.min.y),t.normal.z>0?(e+=t.normal.z*this.min.z,n+=t.normal.z*this.max.z):(e+=t.normal.z*this.max.z,n+=t.normal.z*this.min.z),e<=-t.constant&&n>=-t.constant}intersectsTriangle(t){if(this.isEmpty())return!1;this.getCenter(ol),mh.subVectors(this.max,ol),Ko.subVectors(t.a,ol),Zo.subVectors(t.b,ol),Qo.subVectors(t.c,ol),br.subVectors(Zo,Ko),Sr.subVectors(Qo,Zo),to.subVectors(Ko,Qo);let e=[0,-br.z,br.y,0,-Sr.z,Sr.y,0,-to.z,to.y,br.z,0,-br.x,Sr.z,0,-Sr.x,to.z,0,-to.x,-br.y,br.x,0,-Sr.y,Sr.x,0,-to.y,to.x,0];return!bp(e,Ko,Zo,Qo,mh)||(e=[1,0,0,0,1,0,0,0,1],!bp(e,Ko,Zo,Qo,mh))?!1:(gh.crossVectors(br,Sr),e=[gh.x,gh.y,gh.z],bp(e,Ko,Zo,Qo,mh))}clampPoint(t,e){return e.copy(t).clamp(this.min,this.max)}distanceToPoint(t){return this.clampPoint(t,os).distanceTo(t)}getBoundingSphere(t){return this.isEmpty()?t.makeEmpty():(this.getCenter(t.center),t.radius=this.getSize(os).length()*.5),t}intersect(t){return this.min.max(t.min),this.max.min(t.max),this.isEmpty()&&this.makeEmpty(),this}union(t){return this.min.min(t.min),this.max.max(t.max),this}applyMatrix4(t){return this.isEmpty()?this:(qs[0].set(this.min.x,this.min.y,this.min.z).applyMatrix4(t),qs[1].set(this.min.x,this.min.y,this.max.z).applyMatrix4(t),qs[2].set(this.min.x,this.max.y,this.min.z).applyMatrix4(t),qs[3].set(this.min.x,this.max.y,this.max.z).applyMatrix4(t),qs[4].set(this.max.x,this.min.y,this.min.z).applyMatrix4(t),qs[5].set(this.max.x,this.min.y,this.max.z).applyMatrix4(t),qs[6].set(this.max.x,this.max.y,this.min.z).applyMatrix4(t),qs[7].set(this.max.x,this.max.y,this.max.z).applyMatrix4(t),this.setFromPoints(qs),this)}translate(t){return this.min.add(t),this.max.add(t),this}equals(t){return t.min.equals(this.min)&&t.max.equals(this.max)}toJSON(){return{min:this.min.toArray(),max:this.max.toArray()}}fromJSON(t){return this.min.fromArray(t.min),this.max.fromArray(t.max),this}},qs=[new F,new F,new F,new F,new F,new F,new F,new F],os=new F,ph=new fn,Ko=new F,Zo=new F,Qo=new F,br=new F,Sr=new F,to=new F,ol=new F,mh=new F,gh=new F,eo=new F;function bp(s,t,e,n,i){for(let r=0,o=s.length-3;r<=o;r+=3){eo.fromArray(s,r);let a=i.x*Math.abs(eo.x)+i.y*Math.abs(eo.y)+i.z*Math.abs(eo.z),l=t.dot(eo),c=e.dot(eo),h=n.dot(eo);if(Math.max(-Math.max(l,c,h),Math.min(l,c,h))>a)return!1}return!0}var bn=new F,yh=new Xt,ST=0,hn=class extends ls{constructor(t,e,n=!1){if(super(),Array.isArray(t))throw new TypeError("THREE.BufferAttribute: array should be a Typed Array.");this.isBufferAttribute=!0,Object.defineProperty(this,"id",{value:ST++}),this.name="",this.array=t,this.itemSize=e,this.count=t!==void 0?t.length/e:0,this.normalized=n,this.usage=_m,this.updateRanges=[],this.gpuType=ki,this.version=0,this._normalizationScale=t!==void 0?nd(t):void 0}onUploadCallback(){}set needsUpdate(t){t===!0&&this.version++}setUsage(t){return this.usage=t,this}addUpdateRange(t,e){this.updateRanges.push({start:t,count:e})}clearUpdateRanges(){this.updateRanges.length=0}copy(t){return this.name=t.name,this.array=new t.array.constructor(t.array),this.itemSize=t.itemSize,this.count=t.count,this.normalized=t.normalized,this.usage=t.usage,this.gpuType=t.gpuType,this._normalizationScale=t._normalizationScale,this}copyAt(t,e,n){t*=this.itemSize,n*=e.itemSize;for(let i=0,r=this.itemSize;i<r;i++)this.array[t+i]=e.array[n+i];return this}copyArray(t){return this.array.set(t),this}applyMatrix3(t){if(this.itemSize===2)for(let e=0,n=this.count;e<n;e++)yh.fromBufferAttribute(this,e),yh.applyMatrix3(t),this.setXY(e,yh.x,yh.y);else if(this.itemSize===3)for(let e=0,n=this.count;e<n;e++)bn.fromBufferAttribute(this,e),bn.applyMatrix3(t),this.setXYZ(e,bn.x,bn.y,bn.z);return this}applyMatrix4(t){for(let e=0,n=this.count;e<n;e++)bn.fromBufferAttribute(this,e),bn.applyMatrix4(t),this.setXYZ(e,bn.x,bn.y,bn.z);return this}applyNormalMatrix(t){for(let e=0,n=this.count;e<n;e++)bn.fromBufferAttribute(this,e),bn.applyNormalMatrix(t),this.setXYZ(e,bn.x,bn.y,bn.z);return this}transformDirection(t){for(let e=0,n=this.count;e<n;e++)bn.fromBufferAttribute(this,e),bn.transformDirection(t),this.setXYZ(e,bn.x,bn.y,bn.z);return this}set(t,e=0){return this.array.set(t,e),this}getComponent(t,e){let n=this.array[t*this.itemSize+e];return this.normalized&&(n=this._denormalize(n)),n}setComponent(t,e,n){return this.normalized&&(n=this._normalize(n)),this.array[t*this.itemSize+e]=n,this}getX(t){let e=this.array[t*this.itemSize];return this.normalized&&(e=this._denormalize(e)),e}setX(t,e){return this.normalized&&(e=this._normalize(e)),this.array[t*this.itemSize]=e,this}getY(t){let e=this.array[t*this.itemSize+1];return this.normalized&&(e=this._denormalize(e)),e}setY(t,e){return this.normalized&&(e=this._normalize(e)),this.array[t*this.itemSize+1]=e,this}getZ(t){let e=this.array[t*this.itemSize+2];return this.normalized&&(e=this._denormalize(e)),e}setZ(t,e){return this.normalized&&(e=this._normalize(e)),this.array[t*this.itemSize+2]=e,this}getW(t){let e=this.array[t*this.itemSize+3];return this.normalized&&(e=this._denormalize(e)),e}setW(t,e){return this.normalized&&(e=this._normalize(e)),this.array[t*this.itemSize+3]=e,this}setXY(t,e,n){return t*=this.itemSize,this.normalized&&(e=this._normalize(e),n=this._normalize(n)),this.array[t+0]=e,this.array[t+1]=n,this}setXYZ(t,e,n,i){return t*=this.itemSize,this.normalized&&(e=this._normalize(e),n=this._normalize(n),i=this._normalize(i)),this.array[t+0]=e,this.array[t+1]=n,this.array[t+2]=i,this}setXYZW(t,e,n,i,r){return t*=this.itemSize,this.normalized&&(e=this._normalize(e),n=this._normalize(n),i=this._normalize(i),r=this._normalize(r)),this.array[t+0]=e,this.array[t+1]=n,this.array[t+2]=i,this.array[t+3]=r,this}onUpload(t){return this.onUploadCallback=t,this}clone(){return new this.constructor(this.array,this.itemSize).copy(this)}toJSON(){let t={itemSize:this.itemSize,type:this.array.constructor.name,array:Array.from(this.array),normalized:this.normalized};return t.name=this.name,t.usage=this.usage,t.gpuType=this.gpuType,t}dispose(){this.dispatchEvent({type:"dispose"})}_denormalize(t){let e=this._normalizationScale;return e!==void 0?Math.max(t/e,-1):Sm(t,this.array)}_normalize(t){let e=this._normalizationScale;return e!==void 0?Math.round(t*e):Mm(t,this.array)}};var Ml=class extends hn{constructor(t,e,n){super(new Uint16Array(t),e,n)}};var wl=class extends hn{constructor(t,e,n){super(new Uint32Array(t),e,n)}};var $t=class extends hn{constructor(t,e,n){super(new Float32Array(t),e,n)}},MT=new fn,al=new F,Sp=new F,tn=class{constructor(t=new F,e=-1){this.isSphere=!0,this.center=t,this.radius=e}set(t,e){return this.center.copy(t),this.radius=e,this}setFromPoints(t,e){let n=this.center;e!==void 0?n.copy(e):MT.setFromPoints(t).getCenter(n);let i=0;for(let r=0,o=t.length;r<o;r++)i=Math.max(i,n.distanceToSquared(t[r]));return this.radius=Math.sqrt(i),this}copy(t){return this.center.copy(t.center),this.radius=t.radius,this}isEmpty(){return this.radius<0}makeEmpty(){return this.center.set(0,0,0),this.radius=-1,this}containsPoint(t){return t.distanceToSquared(this.center)<=this.radius*this.radius}distanceToPoint(t){return t.distanceTo(this.center)-this.radius}intersectsSphere(t){let e=this.radius+t.radius;return t.center.distanceToSquared(this.center)<=e*e}intersectsBox(t){return t.intersectsSphere(this)}intersectsPlane(t){return Math.abs(t.distanceToPoint(this.center))<=this.radius}clampPoint(t,e){let n=this.center.distanceToSquared(t);return e.copy(t),n>this.radius*this.radius&&(e.sub(this.center).normalize(),e.multiplyScalar(this.radius).add(this.center)),e}getBoundingBox(t){return this.isEmpty()?(t.makeEmpty(),t):(t.set(this.center,this.center),t.expandByScalar(this.radius),t)}applyMatrix4(t){return this.center.applyMatrix4(t),this.radius=this.radius*t.getMaxScaleOnAxis(),this}translate(t){return this.center.add(t),this}expandByPoint(t){if(this.isEmpty())return this.center.copy(t),this.radius=0,this;al.subVectors(t,this.center);let e=al.lengthSq();if(e>this.radius*this.radius){let n=Math.sqrt(e),i=(n-this.radius)*.5;this.center.addScaledVector(al,i/n),this.radius+=i}return this}union(t){return t.isEmpty()?this:this.isEmpty()?(this.copy(t),this):(this.center.equals(t.center)===!0?this.radius=Math.max(this.radius,t.radius):(Sp.subVectors(t.center,this.center).setLength(t.radius),this.expandByPoint(al.copy(t.center).add(Sp)),this.expandByPoint(al.copy(t.center).sub(Sp))),this)}equals(t){return t.center.equals(this.center)&&t.radius===this.radius}clone(){return new this.constructor().copy(this)}toJSON(){return{radius:this.radius,center:this.center.toArray()}}fromJSON(t){return this.radius=t.radius,this.center.fromArray(t.center),this}},wT=0,qi=new Nt,Mp=new sn,ta=new F,Di=new fn,ll=new fn,Un=new F,Ae=class s extends ls{constructor(){super(),this.isBufferGeometry=!0,Object.defineProperty(this,"id",{value:wT++}),this.uuid=Rs(),this.name="",this.type="BufferGeometry",this.index=null,this.indirect=null,this.indirectOffset=0,this.attributes={},this.morphAttributes={},this.morphTargetsRelative=!1,this.groups=[],this.boundingBox=null,this.boundingSphere=null,this.drawRange={start:0,count:1/0},this.userData={},this._transformed=!1}getIndex(){return this.index}setIndex(t){return Array.isArray(t)?this.index=new($w(t)?wl:Ml)(t,1):this.index=t,this}setIndirect(t,e=0){return this.indirect=t,this.indirectOffset=e,this}getIndirect(){return this.indirect}getAttribute(t){return this.attributes[t]}setAttribute(t,e){return this.attributes[t]=e,this}deleteAttribute(t){return delete this.attributes[t],this}hasAttribute(t){return this.attributes[t]!==void 0}addGroup(t,e,n=0){this.groups.push({start:t,count:e,materialIndex:n})}clearGroups(){this.groups=[]}setDrawRange(t,e){this.drawRange.start=t,this.drawRange.count=e}applyMatrix4(t){let e=this.attributes.position;e!==void 0&&(e.applyMatrix4(t),e.needsUpdate=!0);let n=this.attributes.normal;if(n!==void 0){let r=new se().getNormalMatrix(t);n.applyNormalMatrix(r),n.needsUpdate=!0}let i=this.attributes.tangent;return i!==void 0&&(i.transformDirection(t),i.needsUpdate=!0),this.boundingBox!==null&&this.computeBoundingBox(),this.boundingSphere!==null&&this.computeBoundingSphere(),this._transformed=!0,this}applyQuaternion(t){return qi.makeRotationFromQuaternion(t),this.applyMatrix4(qi),this}rotateX(t){return qi.makeRotationX(t),this.applyMatrix4(qi),this}rotateY(t){return qi.makeRotationY(t),this.applyMatrix4(qi),this}rotateZ(t){return qi.makeRotationZ(t),this.applyMatrix4(qi),this}translate(t,e,n){return qi.makeTranslation(t,e,n),this.applyMatrix4(qi),this}scale(t,e,n){return qi.makeScale(t,e,n),this.applyMatrix4(qi),this}lookAt(t){return Mp.lookAt(t),Mp.updateMatrix(),this.applyMatrix4(Mp.matrix),this}center(){return this.computeBoundingBox(),this.boundingBox.getCenter(ta).negate(),this.translate(ta.x,ta.y,ta.z),this}setFromPoints(t){let e=this.getAttribute("position");if(e===void 0){let n=[];for(let i=0,r=t.length;i<r;i++){let o=t[i];n.push(o.x,o.y,o.z||0)}this.setAttribute("position",new $t(n,3))}else{let n=Math.min(t.length,e.count);for(let i=0;i<n;i++){let r=t[i];e.setXYZ(i,r.x,r.y,r.z||0)}t.length>e.count&&Yt("BufferGeometry: Buffer size too small for points data. Use .dispose() and create a new geometry."),e.needsUpdate=!0}return this}computeBoundingBox(){this.boundingBox===null&&(this.boundingBox=new fn);let t=this.attributes.position,e=this.morphAttributes.position;if(t&&t.isGLBufferAttribute){te("BufferGeometry.computeBoundingBox(): GLBufferAttribute requires a manual bounding box.",this),this.boundingBox.set(new F(-1/0,-1/0,-1/0),new F(1/0,1/0,1/0));return}if(t!==void 0){if(this.boundingBox.setFromBufferAttribute(t),e)for(let n=0,i=e.length;n<i;n++){let r=e[n];Di.setFromBufferAttribute(r),this.morphTargetsRelative?(Un.addVectors(this.boundingBox.min,Di.min),this.boundingBox.expandByPoint(Un),Un.addVectors(this.boundingBox.max,Di.max),this.boundingBox.expandByPoint(Un)):(this.boundingBox.expandByPoint(Di.min),this.boundingBox.expandByPoint(Di.max))}}else this.boundingBox.makeEmpty();(isNaN(this.boundingBox.min.x)||isNaN(this.boundingBox.min.y)||isNaN(this.boundingBox.min.z))&&te('BufferGeometry.computeBoundingBox(): Computed min/max have NaN values. The "position" attribute is likely to have NaN values.',this)}computeBoundingSphere(){this.boundingSphere===null&&(this.boundingSphere=new tn);let t=this.attributes.position,e=this.morphAttributes.position;if(t&&t.isGLBufferAttribute){te("BufferGeometry.computeBoundingSphere(): GLBufferAttribute requires a manual bounding sphere.",this),this.boundingSphere.set(new F,1/0);return}if(t){let n=this.boundingSphere.center;if(Di.setFromBufferAttribute(t),e)for(let r=0,o=e.length;r<o;r++){let a=e[r];ll.setFromBufferAttribute(a),this.morphTargetsRelative?(Un.addVectors(Di.min,ll.min),Di.expandByPoint(Un),Un.addVectors(Di.max,ll.max),Di.expandByPoint(Un)):(Di.expandByPoint(ll.min),Di.expandByPoint(ll.max))}Di.getCenter(n);let i=0;for(let r=0,o=t.count;r<o;r++)Un.fromBufferAttribute(t,r),i=Math.max(i,n.distanceToSquared(Un));if(e)for(let r=0,o=e.length;r<o;r++){let a=e[r],l=this.morphTargetsRelative;for(let c=0,h=a.count;c<h;c++)Un.fromBufferAttribute(a,c),l&&(ta.fromBufferAttribute(t,c),Un.add(ta)),i=Math.max(i,n.distanceToSquared(Un))}this.boundingSphere.radius=Math.sqrt(i),isNaN(this.boundingSphere.radius)&&te('BufferGeometry.computeBoundingSphere(): Computed radius is NaN. The "position" attribute is likely to have NaN values.',this)}}computeTangents(){let t=this.index,e=this.attributes;if(t===null||e.position===void 0||e.normal===void 0||e.uv===void 0){te("BufferGeometry: .computeTangents() failed. Missing required attributes (index, position, normal or uv)");return}let n=e.position,i=e.normal,r=e.uv,o=this.getAttribute("tangent");(o===void 0||o.count!==n.count)&&(o=new hn(new Float32Array(4*n.count),4),this.setAttribute("tangent",o));let a=[],l=[],c=new Uint8Array(n.count);for(let L=0;L<n.count;L++)a[L]=new F,l[L]=new F;let h=new F,u=new F,d=new F,f=new Xt,m=new Xt,y=new Xt,p=new F,g=new F;function _(L,P,R){c[L]=c[P]=c[R]=1,h.fromBufferAttribute(n,L),u.fromBufferAttribute(n,P),d.fromBufferAttribute(n,R),f.fromBufferAttribute(r,L),m.fromBufferAttribute(r,P),y.fromBufferAttribute(r,R),u.sub(h),d.sub(h),m.sub(f),y.sub(f);let O=1/(m.x*y.y-y.x*m.y);isFinite(O)&&(p.copy(u).multiplyScalar(y.y).addScaledVector(d,-m.y).multiplyScalar(O),g.copy(d).multiplyScalar(m.x).addScaledVector(u,-y.x).multiplyScalar(O),a[L].add(p),a[P].add(p),a[R].add(p),l[L].add(g),l[P].add(g),l[R].add(g))}let w=this.groups;w.length===0&&(w=[{start:0,count:t.count}]);for(let L=0,P=w.length;L<P;++L){let R=w[L],O=R.start,k=R.count;for(let N=O,W=O+k;N<W;N+=3)_(t.getX(N+0),t.getX(N+1),t.getX(N+2))}let v=new F,A=new F,S=new F,x=new F;function M(L){S.fromBufferAttribute(i,L),x.copy(S);let P=a[L];v.copy(P),v.sub(S.multiplyScalar(S.dot(P))).normalize(),A.crossVectors(x,P);let O=A.dot(l[L])<0?-1:1;o.setXYZW(L,v.x,v.y,v.z,O)}for(let L=0,P=n.count;L<P;++L)c[L]&&M(L);this._transformed=!0}computeVertexNormals(){let t=this.index,e=this.getAttribute("position");if(e!==void 0){let n=this.getAttribute("normal");if(n===void 0||n.count!==e.count)n=new hn(new Float32Array(e.count*3),3),this.setAttribute("normal",n);else for(let d=0,f=n.count;d<f;d++)n.setXYZ(d,0,0,0);let i=new F,r=new F,o=new F,a=new F,l=new F,c=new F,h=new F,u=new F;if(t)for(let d=0,f=t.count;d<f;d+=3){let m=t.getX(d+0),y=t.getX(d+1),p=t.getX(d+2);i.fromBufferAttribute(e,m),r.fromBufferAttribute(e,y),o.fromBufferAttribute(e,p),h.subVectors(o,r),u.subVectors(i,r),h.cross(u),a.fromBufferAttribute(n,m),l.fromBufferAttribute(n,y),c.fromBufferAttribute(n,p),a.add(h),l.add(h),c.add(h),n.setXYZ(m,a.x,a.y,a.z),n.setXYZ(y,l.x,l.y,l.z),n.setXYZ(p,c.x,c.y,c.z)}else for(let d=0,f=e.count;d<f;d+=3)i.fromBufferAttribute(e,d+0),r.fromBufferAttribute(e,d+1),o.fromBufferAttribute(e,d+2),h.subVectors(o,r),u.subVectors(i,r),h.cross(u),n.setXYZ(d+0,h.x,h.y,h.z),n.setXYZ(d+1,h.x,h.y,h.z),n.setXYZ(d+2,h.x,h.y,h.z);this.normalizeNormals(),n.needsUpdate=!0}}normalizeNormals(){let t=this.attributes.normal;for(let e=0,n=t.count;e<n;e++)Un.fromBufferAttribute(t,e),Un.normalize(),t.setXYZ(e,Un.x,Un.y,Un.z)}toNonIndexed(){function t(a,l){let c=a.array,h=a.itemSize,u=a.normalized,d=new c.constructor(l.length*h),f=0,m=0;for(let y=0,p=l.length;y<p;y++){a.isInterleavedBufferAttribute?f=l[y]*a.data.stride+a.offset:f=l[y]*h;for(let g=0;g<h;g++)d[m++]=c[f++]}return new hn(d,h,u)}if(this.index===null)return Yt("BufferGeometry.toNonIndexed(): BufferGeometry is already non-indexed."),this;let e=new s,n=this.index.array,i=this.attributes;for(let a in i){let l=i[a],c=t(l,n);e.setAttribute(a,c)}let r=this.morphAttributes;for(let a in r){let l=[],c=r[a];for(let h=0,u=c.length;h<u;h++){let d=c[h],f=t(d,n);l.push(f)}e.morphAttributes[a]=l}e.morphTargetsRelative=this.morphTargetsRelative;let o=this.groups;for(let a=0,l=o.length;a<l;a++){let c=o[a];e.addGroup(c.start,c.count,c.materialIndex)}return e}toJSON(){let t={metadata:{version:4.7,type:"BufferGeometry",generator:"BufferGeometry.toJSON"}};if(t.uuid=this.uuid,t.type=this.parameters!==void 0&&this._transformed===!0?"BufferGeometry":this.type,t.name=this.name,Object.keys(this.userData).length>0&&(t.userData=this.userData),this.parameters!==void 0&&this._transformed!==!0){let l=this.parameters;for(let c in l)l[c]!==void 0&&(t[c]=l[c]);return t}t.data={attributes:{}};let e=this.index;e!==null&&(t.data.index={type:e.array.constructor.name,array:Array.prototype.slice.call(e.array)});let n=this.attributes;for(let l in n){let c=n[l];t.data.attributes[l]=c.toJSON(t.data)}let i={},r=!1;for(let l in this.morphAttributes){let c=this.morphAttributes[l],h=[];for(let u=0,d=c.length;u<d;u++){let f=c[u];h.push(f.toJSON(t.data))}h.length>0&&(i[l]=h,r=!0)}r&&(t.data.morphAttributes=i,t.data.morphTargetsRelative=this.morphTargetsRelative);let o=this.groups;o.length>0&&(t.data.groups=JSON.parse(JSON.stringify(o)));let a=this.boundingSphere;return a!==null&&(t.data.boundingSphere=a.toJSON()),t}clone(){return new this.constructor().copy(this)}copy(t){this.index=null,this.attributes={},this.morphAttributes={},this.groups=[],this.boundingBox=null,this.boundingSphere=null;let e={};this.name=t.name;let n=t.index;n!==null&&this.setIndex(n.clone());let i=t.attributes;for(let c in i){let h=i[c];this.setAttribute(c,h.clone(e))}let r=t.morphAttributes;for(let c in r){let h=[],u=r[c];for(let d=0,f=u.length;d<f;d++)h.push(u[d].clone(e));this.morphAttributes[c]=h}this.morphTargetsRelative=t.morphTargetsRelative;let o=t.groups;for(let c=0,h=o.length;c<h;c++){let u=o[c];this.addGroup(u.start,u.count,u.materialIndex)}let a=t.boundingBox;a!==null&&(this.boundingBox=a.clone());let l=t.boundingSphere;return l!==null&&(this.boundingSphere=l.clone()),this.drawRange.start=t.drawRange.start,this.drawRange.count=t.drawRange.count,this.userData=t.userData,this._transformed=t._transformed,this}dispose(){this.dispatchEvent({type:"dispose"})}},nu=class{constructor(t,e){this.isInterleavedBuffer=!0,this.array=t,this.stride=e,this.count=t!==void 0?t.length/e:0,this.usage=_m,this.updateRanges=[],this.version=0,this.uuid=Rs()}onUploadCallback(){}set needsUpdate(t){t===!0&&this.version++}setUsage(t){return this.usage=t,this}addUpdateRange(t,e){this.updateRanges.push({start:t,count:e})}clearUpdateRanges(){this.updateRanges.length=0}copy(t){return this.array=new t.array.constructor(t.array),this.count=t.count,this.stride=t.stride,this.usage=t.usage,this}copyAt(t,e,n){t*=this.stride,n*=e.stride;for(let i=0,r=this.stride;i<r;i++)this.array[t+i]=e.array[n+i];return this}set(t,e=0){return this.array.set(t,e),this}clone(t){t.arrayBuffers===void 0&&(t.arrayBuffers={});let e=l_(this.array);t.arrayBuffers[e]===void 0&&(t.arrayBuffers[e]=this.array.slice(0).buffer);let n=new this.array.constructor(t.arrayBuffers[e]),i=new this.constructor(n,this.stride);return i.setUsage(this.usage),i}onUpload(t){return this.onUploadCallback=t,this}toJSON(t){t.arrayBuffers===void 0&&(t.arrayBuffers={});let e=l_(this.array);t.arrayBuffers[e]===void 0&&(t.arrayBuffers[e]=Array.from(new Uint32Array(this.array.slice(0).buffer)));let n={uuid:this.uuid,buffer:e,type:this.array.constructor.name,stride:this.stride};return n.usage=this.usage,n}};function l_(s){return s.buffer._uuid===void 0&&(s.buffer._uuid=Rs()),s.byteOffset===0&&s.byteLength===s.buffer.byteLength?s.buffer._uuid:s.buffer._uuid+":"+s.byteOffset+":"+s.byteLength}var fi=new F,Wn=class s{constructor(t,e,n,i=!1){this.isInterleavedBufferAttribute=!0,this.name="",this.data=t,this.itemSize=e,this.offset=n,this.normalized=i,this._normalizationScale=t!==void 0?nd(t.array):void 0}get count(){return this.data.count}get array(){return this.data.array}set needsUpdate(t){this.data.needsUpdate=t}applyMatrix4(t){for(let e=0,n=this.data.count;e<n;e++)fi.fromBufferAttribute(this,e),fi.applyMatrix4(t),this.setXYZ(e,fi.x,fi.y,fi.z);return this}applyNormalMatrix(t){for(let e=0,n=this.count;e<n;e++)fi.fromBufferAttribute(this,e),fi.applyNormalMatrix(t),this.setXYZ(e,fi.x,fi.y,fi.z);return this}transformDirection(t){for(let e=0,n=this.count;e<n;e++)fi.fromBufferAttribute(this,e),fi.transformDirection(t),this.setXYZ(e,fi.x,fi.y,fi.z);return this}getComponent(t,e){let n=this.array[t*this.data.stride+this.offset+e];return this.normalized&&(n=this._denormalize(n)),n}setComponent(t,e,n){return this.normalized&&(n=this._normalize(n)),this.data.array[t*this.data.stride+this.offset+e]=n,this}setX(t,e){return this.normalized&&(e=this._normalize(e)),this.data.array[t*this.data.stride+this.offset]=e,this}setY(t,e){return this.normalized&&(e=this._normalize(e)),this.data.array[t*this.data.stride+this.offset+1]=e,this}setZ(t,e){return this.normalized&&(e=this._normalize(e)),this.data.array[t*this.data.stride+this.offset+2]=e,this}setW(t,e){return this.normalized&&(e=this._normalize(e)),this.data.array[t*this.data.stride+this.offset+3]=e,this}getX(t){let e=this.data.array[t*this.data.stride+this.offset];return this.normalized&&(e=this._denormalize(e)),e}getY(t){let e=this.data.array[t*this.data.stride+this.offset+1];return this.normalized&&(e=this._denormalize(e)),e}getZ(t){let e=this.data.array[t*this.data.stride+this.offset+2];return this.normalized&&(e=this._denormalize(e)),e}getW(t){let e=this.data.array[t*this.data.stride+this.offset+3];return this.normalized&&(e=this._denormalize(e)),e}setXY(t,e,n){return t=t*this.data.stride+this.offset,this.normalized&&(e=this._normalize(e),n=this._normalize(n)),this.data.array[t+0]=e,this.data.array[t+1]=n,this}setXYZ(t,e,n,i){return t=t*this.data.stride+this.offset,this.normalized&&(e=this._normalize(e),n=this._normalize(n),i=this._normalize(i)),this.data.array[t+0]=e,this.data.array[t+1]=n,this.data.array[t+2]=i,this}setXYZW(t,e,n,i,r){return t=t*this.data.stride+this.offset,this.normalized&&(e=this._normalize(e),n=this._normalize(n),i=this._normalize(i),r=this._normalize(r)),this.data.array[t+0]=e,this.data.array[t+1]=n,this.data.array[t+2]=i,this.data.array[t+3]=r,this}clone(t){if(t===void 0){vl("InterleavedBufferAttribute.clone(): Cloning an interleaved buffer attribute will de-interleave buffer data.");let e=[];for(let n=0;n<this.count;n++){let i=n*this.data.stride+this.offset;for(let r=0;r<this.itemSize;r++)e.push(this.data.array[i+r])}return new hn(new this.array.constructor(e),this.itemSize,this.normalized)}else return t.interleavedBuffers===void 0&&(t.interleavedBuffers={}),t.interleavedBuffers[this.data.uuid]===void 0&&(t.interleavedBuffers[this.data.uuid]=this.data.clone(t)),new s(t.interleavedBuffers[this.data.uuid],this.itemSize,this.offset,this.normalized)}toJSON(t){if(t===void 0){vl("InterleavedBufferAttribute.toJSON(): Serializing an interleaved buffer attribute will de-interleave buffer data.");let e=[];for(let n=0;n<this.count;n++){let i=n*this.data.stride+this.offset;for(let r=0;r<this.itemSize;r++)e.push(this.data.array[i+r])}return{itemSize:this.itemSize,type:this.array.constructor.name,array:e,normalized:this.normalized}}else return t.interleavedBuffers===void 0&&(t.interleavedBuffers={}),t.interleavedBuffers[this.data.uuid]===void 0&&(t.interleavedBuffers[this.data.uuid]=this.data.toJSON(t)),{isInterleavedBufferAttribute:!0,itemSize:this.itemSize,data:this.data.uuid,offset:this.offset,normalized:this.normalized}}_denormalize(t){let e=this._normalizationScale;return e!==void 0?Math.max(t/e,-1):Sm(t,this.data.array)}_normalize(t){let e=this._normalizationScale;return e!==void 0?Math.round(t*e):Mm(t,this.data.array)}},wp=new F,TT=new F,AT=new se,Oi=class{constructor(t=new F(1,0,0),e=0){this.isPlane=!0,this.normal=t,this.constant=e}set(t,e){return this.normal.copy(t),this.constant=e,this}setComponents(t,e,n,i){return this.normal.set(t,e,n),this.constant=i,this}setFromNormalAndCoplanarPoint(t,e){return this.normal.copy(t),this.constant=-e.dot(this.normal),this}setFromCoplanarPoints(t,e,n){let i=wp.subVectors(n,e).cross(TT.subVectors(t,e)).normalize();return this.setFromNormalAndCoplanarPoint(i,t),this}copy(t){return this.normal.copy(t.normal),this.constant=t.constant,this}normalize(){let t=1/this.normal.length();return this.normal.multiplyScalar(t),this.constant*=t,this}negate(){return this.constant*=-1,this.normal.negate(),this}distanceToPoint(t){return this.normal.dot(t)+this.constant}distanceToSphere(t){return this.distanceToPoint(t.center)-t.radius}projectPoint(t,e){return e.copy(t).addScaledVector(this.normal,-this.distanceToPoint(t))}intersectLine(t,e,n=!0){let i=t.delta(wp),r=this.normal.dot(i);if(r===0)return this.distanceToPoint(t.start)===0?e.copy(t.start):null;let o=-(t.start.dot(this.normal)+this.constant)/r;return n===!0&&(o<0||o>1)?null:e.copy(t.start).addScaledVector(i,o)}intersectsLine(t){let e=this.distanceToPoint(t.start),n=this.distanceToPoint(t.end);return e<0&&n>0||n<0&&e>0}intersectsBox(t){return t.intersectsPlane(this)}intersectsSphere(t){return t.intersectsPlane(this)}coplanarPoint(t){return t.copy(this.normal).multiplyScalar(-this.constant)}applyMatrix4(t,e){let n=e||AT.getNormalMatrix(t),i=this.coplanarPoint(wp).applyMatrix4(t),r=this.normal.applyMatrix3(n).normalize();return this.constant=-i.dot(r),this}translate(t){return this.constant-=t.dot(this.normal),this}equals(t){return t.normal.equals(this.normal)&&t.constant===this.constant}clone(){return new this.constructor().copy(this)}toJSON(){return{normal:this.normal.toArray(),constant:this.constant}}fromJSON(t){return this.normal.fromArray(t.normal),this.constant=t.constant,this}},ET=0,gi=class extends ls{constructor(){super(),this.isMaterial=!0,Object.defineProperty(this,"id",{value:ET++}),this.uuid=Rs(),this.name="",this.type="Material",this.blending=Ea,this.side=Es,this.vertexColors=!1,this.opacity=1,this.transparent=!1,this.alphaHash=!1,this.blendSrc=Qp,this.blendDst=tm,this.blendEquation=yo,this.blendSrcAlpha=null,this.blendDstAlpha=null,this.blendEquationAlpha=null,this.blendColor=new Rt(0,0,0),this.blendAlpha=0,this.depthFunc=ha,this.depthTest=!0,this.depthWrite=!0,this.stencilWriteMask=255,this.stencilFunc=gx,this.stencilRef=0,this.stencilFuncMask=255,this.stencilFail=Hh,this.stencilZFail=Hh,this.stencilZPass=Hh,this.stencilWrite=!1,this.clippingPlanes=null,this.clipIntersection=!1,this.clipShadows=!1,this.shadowSide=null,this.colorWrite=!0,this.precision=null,this.polygonOffset=!1,this.polygonOffsetFactor=0,this.polygonOffsetUnits=0,this.dithering=!1,this.alphaToCoverage=!1,this.premultipliedAlpha=!1,this.forceSinglePass=!1,this.allowOverride=!0,this.visible=!0,this.toneMapped=!0,this.userData={},this.version=0,this._alphaTest=0}get alphaTest(){return this._alphaTest}set alphaTest(t){this._alphaTest>0!=t>0&&this.version++,this._alphaTest=t}onBeforeRender(){}onBeforeCompile(){}customProgramCacheKey(){return this.onBeforeCompile.toString()}setValues(t){if(t!==void 0)for(let e in t){let n=t[e];if(n===void 0){Yt(`Material: parameter '${e}' has value of undefined.`);continue}let i=this[e];if(i===void 0){Yt(`Material: '${e}' is not a property of THREE.${this.type}.`);continue}i&&i.isColor?i.set(n):i&&i.isVector2&&n&&n.isVector2||i&&i.isEuler&&n&&n.isEuler||i&&i.isVector3&&n&&n.isVector3?i.copy(n):this[e]=n}}toJSON(t){let e=t===void 0||typeof t=="string";e&&(t={textures:{},images:{}});let n={metadata:{version:4.7,type:"Material",generator:"Material.toJSON"}};n.uuid=this.uuid,n.type=this.type,n.blending=this.blending,n.side=this.side,n.shadowSide=this.shadowSide,n.vertexColors=this.vertexColors,n.opacity=this.opacity,n.transparent=this.transparent,n.blendSrc=this.blendSrc,n.blendDst=this.blendDst,n.blendEquation=this.blendEquation,n.blendSrcAlpha=this.blendSrcAlpha,n.blendDstAlpha=this.blendDstAlpha,n.blendEquationAlpha=this.blendEquationAlpha,n.blendColor=this.blendColor.getHex(),n.blendAlpha=this.blendAlpha,n.depthFunc=this.depthFunc,n.depthTest=this.depthTest,n.depthWrite=this.depthWrite,n.colorWrite=this.colorWrite,n.clipIntersection=this.clipIntersection,n.clipShadows=this.clipShadows,n.stencilWriteMask=this.stencilWriteMask,n.stencilFunc=this.stencilFunc,n.stencilRef=this.stencilRef,n.stencilFuncMask=this.stencilFuncMask,n.stencilFail=this.stencilFail,n.stencilZFail=this.stencilZFail,n.stencilZPass=this.stencilZPass,n.stencilWrite=this.stencilWrite,n.polygonOffset=this.polygonOffset,n.polygonOffsetFactor=this.polygonOffsetFactor,n.polygonOffsetUnits=this.polygonOffsetUnits,n.dithering=this.dithering,n.alphaTest=this.alphaTest,n.alphaHash=this.alphaHash,n.alphaToCoverage=this.alphaToCoverage,n.premultipliedAlpha=this.premultipliedAlpha,n.forceSinglePass=this.forceSinglePass,n.allowOverride=this.allowOverride,n.visible=this.visible,n.toneMapped=this.toneMapped,n.name=this.name,this.color&&this.color.isColor&&(n.color=this.color.getHex()),this.roughness!==void 0&&(n.roughness=this.roughness),this.metalness!==void 0&&(n.metalness=this.metalness),this.sheen!==void 0&&(n.sheen=this.sheen),this.sheenColor&&this.sheenColor.isColor&&(n.sheenColor=this.sheenColor.getHex()),this.sheenRoughness!==void 0&&(n.sheenRoughness=this.sheenRoughness),this.emissive&&this.emissive.isColor&&(n.emissive=this.emissive.getHex()),this.emissiveIntensity!==void 0&&(n.emissiveIntensity=this.emissiveIntensity),this.specular&&this.specular.isColor&&(n.specular=this.specular.getHex()),this.specularIntensity!==void 0&&(n.specularIntensity=this.specularIntensity),this.specularColor&&this.specularColor.isColor&&(n.specularColor=this.specularColor.getHex()),this.shininess!==void 0&&(n.shininess=this.shininess),this.clearcoat!==void 0&&(n.clearcoat=this.clearcoat),this.clearcoatRoughness!==void 0&&(n.clearcoatRoughness=this.clearcoatRoughness),this.diffuseRoughness!==void 0&&(n.diffuseRoughness=this.diffuseRoughness),this.diffuseRoughnessMap&&this.diffuseRoughnessMap.isTexture&&(n.diffuseRoughnessMap=this.diffuseRoughnessMap.toJSON(t).uuid),this.clearcoatMap&&this.clearcoatMap.isTexture&&(n.clearcoatMap=this.clearcoatMap.toJSON(t).uuid),this.clearcoatRoughnessMap&&this.clearcoatRoughnessMap.isTexture&&(n.clearcoatRoughnessMap=this.clearcoatRoughnessMap.toJSON(t).uuid),this.clearcoatNormalMap&&this.clearcoatNormalMap.isTexture&&(n.clearcoatNormalMap=this.clearcoatNormalMap.toJSON(t).uuid,n.clearcoatNormalScale=this.clearcoatNormalScale.toArray()),this.sheenColorMap&&this.sheenColorMap.isTexture&&(n.sheenColorMap=this.sheenColorMap.toJSON(t).uuid),this.sheenRoughnessMap&&this.sheenRoughnessMap.isTexture&&(n.sheenRoughnessMap=this.sheenRoughnessMap.toJSON(t).uuid),this.dispersion!==void 0&&(n.dispersion=this.dispersion),this.retroreflectivity!==void 0&&(n.retroreflectivity=this.retroreflectivity),this.iridescence!==void 0&&(n.iridescence=this.iridescence),this.iridescenceIOR!==void 0&&(n.iridescenceIOR=this.iridescenceIOR),this.iridescenceThicknessMinimum!==void 0&&(n.iridescenceThicknessMinimum=this.iridescenceThicknessMinimum),this.iridescenceThicknessMaximum!==void 0&&(n.iridescenceThicknessMaximum=this.iridescenceThicknessMaximum),this.iridescenceMap&&this.iridescenceMap.isTexture&&(n.iridescenceMap=this.iridescenceMap.toJSON(t).uuid),this.iridescenceThicknessMap&&this.iridescenceThicknessMap.isTexture&&(n.iridescenceThicknessMap=this.iridescenceThicknessMap.toJSON(t).uuid),this.anisotropy!==void 0&&(n.anisotropy=this.anisotropy),this.anisotropyRotation!==void 0&&(n.anisotropyRotation=this.anisotropyRotation),this.anisotropyMap&&this.anisotropyMap.isTexture&&(n.anisotropyMap=this.anisotropyMap.toJSON(t).uuid),this.map&&this.map.isTexture&&(n.map=this.map.toJSON(t).uuid),this.matcap&&this.matcap.isTexture&&(n.matcap=this.matcap.toJSON(t).uuid),this.alphaMap&&this.alphaMap.isTexture&&(n.alphaMap=this.alphaMap.toJSON(t).uuid),this.lightMap&&this.lightMap.isTexture&&(n.lightMap=this.lightMap.toJSON(t).uuid,n.lightMapIntensity=this.lightMapIntensity),this.aoMap&&this.aoMap.isTexture&&(n.aoMap=this.aoMap.toJSON(t).uuid,n.aoMapIntensity=this.aoMapIntensity),this.bumpMap&&this.bumpMap.isTexture&&(n.bumpMap=this.bumpMap.toJSON(t).uuid,n.bumpScale=this.bumpScale),this.normalMap&&this.normalMap.isTexture&&(n.normalMap=this.normalMap.toJSON(t).uuid,n.normalMapType=this.normalMapType,n.normalScale=this.normalScale.toArray()),this.displacementMap&&this.displacementMap.isTexture&&(n.displacementMap=this.displacementMap.toJSON(t).uuid,n.displacementScale=this.displacementScale,n.displacementBias=this.displacementBias),this.roughnessMap&&this.roughnessMap.isTexture&&(n.roughnessMap=this.roughnessMap.toJSON(t).uuid),this.metalnessMap&&this.metalnessMap.isTexture&&(n.metalnessMap=this.metalnessMap.toJSON(t).uuid),this.emissiveMap&&this.emissiveMap.isTexture&&(n.emissiveMap=this.emissiveMap.toJSON(t).uuid),this.specularMap&&this.specularMap.isTexture&&(n.specularMap=this.specularMap.toJSON(t).uuid),this.specularIntensityMap&&this.specularIntensityMap.isTexture&&(n.specularIntensityMap=this.specularIntensityMap.toJSON(t).uuid),this.specularColorMap&&this.specularColorMap.isTexture&&(n.specularColorMap=this.specularColorMap.toJSON(t).uuid),this.envMap&&this.envMap.isTexture&&(n.envMap=this.envMap.toJSON(t).uuid,this.combine!==void 0&&(n.combine=this.combine)),this.envMapRotation!==void 0&&(n.envMapRotation=this.envMapRotation.toArray()),this.envMapIntensity!==void 0&&(n.envMapIntensity=this.envMapIntensity),this.reflectivity!==void 0&&(n.reflectivity=this.reflectivity),this.refractionRatio!==void 0&&(n.refractionRatio=this.refractionRatio),this.gradientMap&&this.gradientMap.isTexture&&(n.gradientMap=this.gradientMap.toJSON(t).uuid),this.transmission!==void 0&&(n.transmission=this.transmission),this.transmissionMap&&this.transmissionMap.isTexture&&(n.transmissionMap=this.transmissionMap.toJSON(t).uuid),this.thickness!==void 0&&(n.thickness=this.thickness),this.thicknessMap&&this.thicknessMap.isTexture&&(n.thicknessMap=this.thicknessMap.toJSON(t).uuid),this.attenuationDistance!==void 0&&(n.attenuationDistance=this.attenuationDistance),this.attenuationColor!==void 0&&(n.attenuationColor=this.attenuationColor.getHex()),this.size!==void 0&&(n.size=this.size),this.sizeAttenuation!==void 0&&(n.sizeAttenuation=this.sizeAttenuation),Array.isArray(this.clippingPlanes)&&this.clippingPlanes.length>0&&(n.clippingPlanes=this.clippingPlanes.map(r=>r.toJSON())),this.rotation!==void 0&&(n.rotation=this.rotation),this.depthPacking!==void 0&&(n.depthPacking=this.depthPacking),this.linewidth!==void 0&&(n.linewidth=this.linewidth),this.linecap!==void 0&&(n.linecap=this.linecap),this.linejoin!==void 0&&(n.linejoin=this.linejoin),this.dashSize!==void 0&&(n.dashSize=this.dashSize),this.gapSize!==void 0&&(n.gapSize=this.gapSize),this.scale!==void 0&&(n.scale=this.scale),this.wireframe!==void 0&&(n.wireframe=this.wireframe),this.wireframeLinewidth!==void 0&&(n.wireframeLinewidth=this.wireframeLinewidth),this.wireframeLinecap!==void 0&&(n.wireframeLinecap=this.wireframeLinecap),this.wireframeLinejoin!==void 0&&(n.wireframeLinejoin=this.wireframeLinejoin),this.flatShading!==void 0&&(n.flatShading=this.flatShading),this.fog!==void 0&&(n.fog=this.fog),Object.keys(this.userData).length>0&&(n.userData=this.userData);function i(r){let o=[];for(let a in r){let l=r[a];delete l.metadata,o.push(l)}return o}if(e){let r=i(t.textures),o=i(t.images);r.length>0&&(n.textures=r),o.length>0&&(n.images=o)}return n}fromJSON(t,e){if(t.uuid!==void 0&&(this.uuid=t.uuid),t.name!==void 0&&(this.name=t.name),t.color!==void 0&&this.color!==void 0&&this.color.setHex(t.color),t.roughness!==void 0&&(this.roughness=t.roughness),t.metalness!==void 0&&(this.metalness=t.metalness),t.sheen!==void 0&&(this.sheen=t.sheen),t.sheenColor!==void 0&&(this.sheenColor=new Rt().setHex(t.sheenColor)),t.sheenRoughness!==void 0&&(this.sheenRoughness=t.sheenRoughness),t.emissive!==void 0&&this.emissive!==void 0&&this.emissive.setHex(t.emissive),t.specular!==void 0&&this.specular!==void 0&&this.specular.setHex(t.specular),t.specularIntensity!==void 0&&(this.specularIntensity=t.specularIntensity),t.specularColor!==void 0&&this.specularColor!==void 0&&this.specularColor.setHex(t.specularColor),t.shininess!==void 0&&(this.shininess=t.shininess),t.clearcoat!==void 0&&(this.clearcoat=t.clearcoat),t.clearcoatRoughness!==void 0&&(this.clearcoatRoughness=t.clearcoatRoughness),t.diffuseRoughness!==void 0&&(this.diffuseRoughness=t.diffuseRoughness),t.dispersion!==void 0&&(this.dispersion=t.dispersion),t.retroreflectivity!==void 0&&(this.retroreflectivity=t.retroreflectivity),t.iridescence!==void 0&&(this.iridescence=t.iridescence),t.iridescenceIOR!==void 0&&(this.iridescenceIOR=t.iridescenceIOR),t.iridescenceThicknessMinimum!==void 0&&(this.iridescenceThicknessMinimum=t.iridescenceThicknessMinimum),t.iridescenceThicknessMaximum!==void 0&&(this.iridescenceThicknessMaximum=t.iridescenceThicknessMaximum),t.iridescenceThicknessRange!==void 0&&(this.iridescenceThicknessMinimum=t.iridescenceThicknessRange[0],this.iridescenceThicknessMaximum=t.iridescenceThicknessRange[1]),t.transmission!==void 0&&(this.transmission=t.transmission),t.thickness!==void 0&&(this.thickness=t.thickness),t.attenuationDistance!==void 0&&(this.attenuationDistance=t.attenuationDistance),t.attenuationColor!==void 0&&this.attenuationColor!==void 0&&this.attenuationColor.setHex(t.attenuationColor),t.anisotropy!==void 0&&(this.anisotropy=t.anisotropy),t.anisotropyRotation!==void 0&&(this.anisotropyRotation=t.anisotropyRotation),t.fog!==void 0&&(this.fog=t.fog),t.flatShading!==void 0&&(this.flatShading=t.flatShading),t.blending!==void 0&&(this.blending=t.blending),t.combine!==void 0&&(this.combine=t.combine),t.side!==void 0&&(this.side=t.side),t.shadowSide!==void 0&&(this.shadowSide=t.shadowSide),t.opacity!==void 0&&(this.opacity=t.opacity),t.transparent!==void 0&&(this.transparent=t.transparent),t.alphaTest!==void 0&&(this.alphaTest=t.alphaTest),t.alphaHash!==void 0&&(this.alphaHash=t.alphaHash),t.depthFunc!==void 0&&(this.depthFunc=t.depthFunc),t.depthTest!==void 0&&(this.depthTest=t.depthTest),t.depthWrite!==void 0&&(this.depthWrite=t.depthWrite),t.colorWrite!==void 0&&(this.colorWrite=t.colorWrite),t.clippingPlanes!==void 0&&(this.clippingPlanes=t.clippingPlanes.map(n=>new Oi().fromJSON(n))),t.clipIntersection!==void 0&&(this.clipIntersection=t.clipIntersection),t.clipShadows!==void 0&&(this.clipShadows=t.clipShadows),t.depthPacking!==void 0&&(this.depthPacking=t.depthPacking),t.blendSrc!==void 0&&(this.blendSrc=t.blendSrc),t.blendDst!==void 0&&(this.blendDst=t.blendDst),t.blendEquation!==void 0&&(this.blendEquation=t.blendEquation),t.blendSrcAlpha!==void 0&&(this.blendSrcAlpha=t.blendSrcAlpha),t.blendDstAlpha!==void 0&&(this.blendDstAlpha=t.blendDstAlpha),t.blendEquationAlpha!==void 0&&(this.blendEquationAlpha=t.blendEquationAlpha),t.blendColor!==void 0&&this.blendColor!==void 0&&this.blendColor.setHex(t.blendColor),t.blendAlpha!==void 0&&(this.blendAlpha=t.blendAlpha),t.stencilWriteMask!==void 0&&(this.stencilWriteMask=t.stencilWriteMask),t.stencilFunc!==void 0&&(this.stencilFunc=t.stencilFunc),t.stencilRef!==void 0&&(this.stencilRef=t.stencilRef),t.stencilFuncMask!==void 0&&(this.stencilFuncMask=t.stencilFuncMask),t.stencilFail!==void 0&&(this.stencilFail=t.stencilFail),t.stencilZFail!==void 0&&(this.stencilZFail=t.stencilZFail),t.stencilZPass!==void 0&&(this.stencilZPass=t.stencilZPass),t.stencilWrite!==void 0&&(this.stencilWrite=t.stencilWrite),t.wireframe!==void 0&&(this.wireframe=t.wireframe),t.wireframeLinewidth!==void 0&&(this.wireframeLinewidth=t.wireframeLinewidth),t.wireframeLinecap!==void 0&&(this.wireframeLinecap=t.wireframeLinecap),t.wireframeLinejoin!==void 0&&(this.wireframeLinejoin=t.wireframeLinejoin),t.rotation!==void 0&&(this.rotation=t.rotation),t.linewidth!==void 0&&(this.linewidth=t.linewidth),t.linecap!==void 0&&(this.linecap=t.linecap),t.linejoin!==void 0&&(this.linejoin=t.linejoin),t.dashSize!==void 0&&(this.dashSize=t.dashSize),t.gapSize!==void 0&&(this.gapSize=t.gapSize),t.scale!==void 0&&(this.scale=t.scale),t.polygonOffset!==void 0&&(this.polygonOffset=t.polygonOffset),t.polygonOffsetFactor!==void 0&&(this.polygonOffsetFactor=t.polygonOffsetFactor),t.polygonOffsetUnits!==void 0&&(this.polygonOffsetUnits=t.polygonOffsetUnits),t.dithering!==void 0&&(this.dithering=t.dithering),t.alphaToCoverage!==void 0&&(this.alphaToCoverage=t.alphaToCoverage),t.premultipliedAlpha!==void 0&&(this.premultipliedAlpha=t.premultipliedAlpha),t.forceSinglePass!==void 0&&(this.forceSinglePass=t.forceSinglePass),t.allowOverride!==void 0&&(this.allowOverride=t.allowOverride),t.visible!==void 0&&(this.visible=t.visible),t.toneMapped!==void 0&&(this.toneMapped=t.toneMapped),t.userData!==void 0&&(this.userData=t.userData),t.vertexColors!==void 0&&(typeof t.vertexColors=="number"?this.vertexColors=t.vertexColors>0:this.vertexColors=t.vertexColors),t.size!==void 0&&(this.size=t.size),t.sizeAttenuation!==void 0&&(this.sizeAttenuation=t.sizeAttenuation),t.map!==void 0&&(this.map=e[t.map]||null),t.matcap!==void 0&&(this.matcap=e[t.matcap]||null),t.alphaMap!==void 0&&(this.alphaMap=e[t.alphaMap]||null),t.bumpMap!==void 0&&(this.bumpMap=e[t.bumpMap]||null),t.bumpScale!==void 0&&(this.bumpScale=t.bumpScale),t.normalMap!==void 0&&(this.normalMap=e[t.normalMap]||null),t.normalMapType!==void 0&&(this.normalMapType=t.normalMapType),t.normalScale!==void 0){let n=t.normalScale;Array.isArray(n)===!1&&(n=[n,n]),this.normalScale=new Xt().fromArray(n)}return t.displacementMap!==void 0&&(this.displacementMap=e[t.displacementMap]||null),t.displacementScale!==void 0&&(this.displacementScale=t.displacementScale),t.displacementBias!==void 0&&(this.displacementBias=t.displacementBias),t.roughnessMap!==void 0&&(this.roughnessMap=e[t.roughnessMap]||null),t.metalnessMap!==void 0&&(this.metalnessMap=e[t.metalnessMap]||null),t.emissiveMap!==void 0&&(this.emissiveMap=e[t.emissiveMap]||null),t.emissiveIntensity!==void 0&&(this.emissiveIntensity=t.emissiveIntensity),t.specularMap!==void 0&&(this.specularMap=e[t.specularMap]||null),t.specularIntensityMap!==void 0&&(this.specularIntensityMap=e[t.specularIntensityMap]||null),t.specularColorMap!==void 0&&(this.specularColorMap=e[t.specularColorMap]||null),t.envMap!==void 0&&(this.envMap=e[t.envMap]||null),t.envMapRotation!==void 0&&this.envMapRotation.fromArray(t.envMapRotation),t.envMapIntensity!==void 0&&(this.envMapIntensity=t.envMapIntensity),t.reflectivity!==void 0&&(this.reflectivity=t.reflectivity),t.refractionRatio!==void 0&&(this.refractionRatio=t.refractionRatio),t.lightMap!==void 0&&(this.lightMap=e[t.lightMap]||null),t.lightMapIntensity!==void 0&&(this.lightMapIntensity=t.lightMapIntensity),t.aoMap!==void 0&&(this.aoMap=e[t.aoMap]||null),t.aoMapIntensity!==void 0&&(this.aoMapIntensity=t.aoMapIntensity),t.gradientMap!==void 0&&(this.gradientMap=e[t.gradientMap]||null),t.clearcoatMap!==void 0&&(this.clearcoatMap=e[t.clearcoatMap]||null),t.clearcoatRoughnessMap!==void 0&&(this.clearcoatRoughnessMap=e[t.clearcoatRoughnessMap]||null),t.clearcoatNormalMap!==void 0&&(this.clearcoatNormalMap=e[t.clearcoatNormalMap]||null),t.clearcoatNormalScale!==void 0&&(this.clearcoatNormalScale=new Xt().fromArray(t.clearcoatNormalScale)),t.diffuseRoughnessMap!==void 0&&(this.diffuseRoughnessMap=e[t.diffuseRoughnessMap]||null),t.iridescenceMap!==void 0&&(this.iridescenceMap=e[t.iridescenceMap]||null),t.iridescenceThicknessMap!==void 0&&(this.iridescenceThicknessMap=e[t.iridescenceThicknessMap]||null),t.transmissionMap!==void 0&&(this.transmissionMap=e[t.transmissionMap]||null),t.thicknessMap!==void 0&&(this.thicknessMap=e[t.thicknessMap]||null),t.anisotropyMap!==void 0&&(this.anisotropyMap=e[t.anisotropyMap]||null),t.sheenColorMap!==void 0&&(this.sheenColorMap=e[t.sheenColorMap]||null),t.sheenRoughnessMap!==void 0&&(this.sheenRoughnessMap=e[t.sheenRoughnessMap]||null),this}clone(){return new this.constructor().copy(this)}copy(t){this.name=t.name,this.blending=t.blending,this.side=t.side,this.vertexColors=t.vertexColors,this.opacity=t.opacity,this.transparent=t.transparent,this.blendSrc=t.blendSrc,this.blendDst=t.blendDst,this.blendEquation=t.blendEquation,this.blendSrcAlpha=t.blendSrcAlpha,this.blendDstAlpha=t.blendDstAlpha,this.blendEquationAlpha=t.blendEquationAlpha,this.blendColor.copy(t.blendColor),this.blendAlpha=t.blendAlpha,this.depthFunc=t.depthFunc,this.depthTest=t.depthTest,this.depthWrite=t.depthWrite,this.stencilWriteMask=t.stencilWriteMask,this.stencilFunc=t.stencilFunc,this.stencilRef=t.stencilRef,this.stencilFuncMask=t.stencilFuncMask,this.stencilFail=t.stencilFail,this.stencilZFail=t.stencilZFail,this.stencilZPass=t.stencilZPass,this.stencilWrite=t.stencilWrite;let e=t.clippingPlanes,n=null;if(e!==null){let i=e.length;n=new Array(i);for(let r=0;r!==i;++r)n[r]=e[r].clone()}return this.clippingPlanes=n,this.clipIntersection=t.clipIntersection,this.clipShadows=t.clipShadows,this.shadowSide=t.shadowSide,this.colorWrite=t.colorWrite,this.precision=t.precision,this.polygonOffset=t.polygonOffset,this.polygonOffsetFactor=t.polygonOffsetFactor,this.polygonOffsetUnits=t.polygonOffsetUnits,this.dithering=t.dithering,this.alphaTest=t.alphaTest,this.alphaHash=t.alphaHash,this.alphaToCoverage=t.alphaToCoverage,this.premultipliedAlpha=t.premultipliedAlpha,this.forceSinglePass=t.forceSinglePass,this.allowOverride=t.allowOverride,this.visible=t.visible,this.toneMapped=t.toneMapped,this.userData=JSON.parse(JSON.stringify(t.userData)),this}dispose(){this.dispatchEvent({type:"dispose"})}set needsUpdate(t){t===!0&&this.version++}};var js=new F,Tp=new F,_h=new F,xh=new F,Ss=class{constructor(t=new F,e=new F(0,0,-1)){this.origin=t,this.direction=e}set(t,e){return this.origin.copy(t),this.direction.copy(e),this}copy(t){return this.origin.copy(t.origin),this.direction.copy(t.direction),this}at(t,e){return e.copy(this.origin).addScaledVector(this.direction,t)}lookAt(t){return this.direction.copy(t).sub(this.origin).normalize(),this}recast(t){return this.origin.copy(this.at(t,js)),this}closestPointToPoint(t,e){e.subVectors(t,this.origin);let n=e.dot(this.direction);return n<0?e.copy(this.origin):e.copy(this.origin).addScaledVector(this.direction,n)}distanceToPoint(t){return Math.sqrt(this.distanceSqToPoint(t))}distanceSqToPoint(t){let e=js.subVectors(t,this.origin).dot(this.direction);return e<0?this.origin.distanceToSquared(t):(js.copy(this.origin).addScaledVector(this.direction,e),js.distanceToSquared(t))}distanceSqToSegment(t,e,n,i){Tp.copy(t).add(e).multiplyScalar(.5),_h.copy(e).sub(t).normalize(),xh.copy(this.origin).sub(Tp);let r=t.distanceTo(e)*.5,o=-this.direction.dot(_h),a=xh.dot(this.direction),l=-xh.dot(_h),c=xh.lengthSq(),h=Math.abs(1-o*o),u,d,f,m;if(h>0)if(u=o*l-a,d=o*a-l,m=r*h,u>=0)if(d>=-m)if(d<=m){let y=1/h;u*=y,d*=y,f=u*(u+o*d+2*a)+d*(o*u+d+2*l)+c}else d=r,u=Math.max(0,-(o*d+a)),f=-u*u+d*(d+2*l)+c;else d=-r,u=Math.max(0,-(o*d+a)),f=-u*u+d*(d+2*l)+c;else d<=-m?(u=Math.max(0,-(-o*r+a)),d=u>0?-r:Math.min(Math.max(-r,-l),r),f=-u*u+d*(d+2*l)+c):d<=m?(u=0,d=Math.min(Math.max(-r,-l),r),f=d*(d+2*l)+c):(u=Math.max(0,-(o*r+a)),d=u>0?r:Math.min(Math.max(-r,-l),r),f=-u*u+d*(d+2*l)+c);else d=o>0?-r:r,u=Math.max(0,-(o*d+a)),f=-u*u+d*(d+2*l)+c;return n&&n.copy(this.origin).addScaledVector(this.direction,u),i&&i.copy(Tp).addScaledVector(_h,d),f}intersectSphere(t,e){if(t.radius<0)return null;js.subVectors(t.center,this.origin);let n=js.dot(this.direction),i=js.dot(js)-n*n,r=t.radius*t.radius;if(i>r)return null;let o=Math.sqrt(r-i),a=n-o,l=n+o;return l<0?null:a<0?this.at(l,e):this.at(a,e)}intersectsSphere(t){return t.radius<0?!1:this.distanceSqToPoint(t.center)<=t.radius*t.radius}distanceToPlane(t){let e=t.normal.dot(this.direction);if(e===0)return t.distanceToPoint(this.origin)===0?0:null;let n=-(this.origin.dot(t.normal)+t.constant)/e;return n>=0?n:null}intersectPlane(t,e){let n=this.distanceToPlane(t);return n===null?null:this.at(n,e)}intersectsPlane(t){let e=t.distanceToPoint(this.origin);return e===0||t.normal.dot(this.direction)*e<0}intersectBox(t,e){let n,i,r,o,a,l,c=1/this.direction.x,h=1/this.direction.y,u=1/this.direction.z,d=this.origin;return c>=0?(n=(t.min.x-d.x)*c,i=(t.max.x-d.x)*c):(n=(t.max.x-d.x)*c,i=(t.min.x-d.x)*c),h>=0?(r=(t.min.y-d.y)*h,o=(t.max.y-d.y)*h):(r=(t.max.y-d.y)*h,o=(t.min.y-d.y)*h),n>o||r>i||((r>n||isNaN(n))&&(n=r),(o<i||isNaN(i))&&(i=o),u>=0?(a=(t.min.z-d.z)*u,l=(t.max.z-d.z)*u):(a=(t.max.z-d.z)*u,l=(t.min.z-d.z)*u),n>l||a>i)||((a>n||n!==n)&&(n=a),(l<i||i!==i)&&(i=l),i<0)?null:this.at(n>=0?n:i,e)}intersectsBox(t){return this.intersectBox(t,js)!==null}intersectTriangle(t,e,n,i,r){let o=this.origin,a=this.direction,l=a.x,c=a.y,h=a.z,u=t.x-o.x,d=t.y-o.y,f=t.z-o.z,m=e.x-o.x,y=e.y-o.y,p=e.z-o.z,g=n.x-o.x,_=n.y-o.y,w=n.z-o.z,v=Math.abs(l),A=Math.abs(c),S=Math.abs(h),x,M,L,P,R,O,k,N,W,z,H,it;if(v>=A&&v>=S?(L=l,O=u,W=m,it=g,l>=0?(x=c,M=h,P=d,R=f,k=y,N=p,z=_,H=w):(x=h,M=c,P=f,R=d,k=p,N=y,z=w,H=_)):A>=S?(L=c,O=d,W=y,it=_,c>=0?(x=h,M=l,P=f,R=u,k=p,N=m,z=w,H=g):(x=l,M=h,P=u,R=f,k=m,N=p,z=g,H=w)):(L=h,O=f,W=p,it=w,h>=0?(x=l,M=c,P=u,R=d,k=m,N=y,z=g,H=_):(x=c,M=l,P=d,R=u,k=y,N=m,z=_,H=g)),L===0)return null;let Y=x/L,K=M/L,tt=1/L,ht=P-Y*O,st=R-K*O,j=k-Y*W,rt=N-K*W,nt=z-Y*it,lt=H-K*it,gt=nt*rt-lt*j,Ut=ht*lt-st*nt,Kt=j*st-rt*ht;if(i){if(gt<0||Ut<0||Kt<0)return null}else if((gt<0||Ut<0||Kt<0)&&(gt>0||Ut>0||Kt>0))return null;let zt=gt+Ut+Kt;if(zt===0)return null;let ge=tt*(gt*O+Ut*W+Kt*it);return(zt>0?ge<0:ge>0)?null:this.at(ge/zt,r)}applyMatrix4(t){return this.origin.applyMatrix4(t),this.direction.transformDirection(t),this}equals(t){return t.origin.equals(this.origin)&&t.direction.equals(this.direction)}clone(){return new this.constructor().copy(this)}},Ui=class extends gi{constructor(t){super(),this.isMeshBasicMaterial=!0,this.type="MeshBasicMaterial",this.color=new Rt(16777215),this.map=null,this.lightMap=null,this.lightMapIntensity=1,this.aoMap=null,this.aoMapIntensity=1,this.specularMap=null,this.alphaMap=null,this.envMap=null,this.envMapRotation=new xi,this.combine=$l,this.reflectivity=1,this.refractionRatio=.98,this.wireframe=!1,this.wireframeLinewidth=1,this.wireframeLinecap="round",this.wireframeLinejoin="round",this.fog=!0,this.setValues(t)}copy(t){return super.copy(t),this.color.copy(t.color),this.map=t.map,this.lightMap=t.lightMap,this.lightMapIntensity=t.lightMapIntensity,this.aoMap=t.aoMap,this.aoMapIntensity=t.aoMapIntensity,this.specularMap=t.specularMap,this.alphaMap=t.alphaMap,this.envMap=t.envMap,this.envMapRotation.copy(t.envMapRotation),this.combine=t.combine,this.reflectivity=t.reflectivity,this.refractionRatio=t.refractionRatio,this.wireframe=t.wireframe,this.wireframeLinewidth=t.wireframeLinewidth,this.wireframeLinecap=t.wireframeLinecap,this.wireframeLinejoin=t.wireframeLinejoin,this.fog=t.fog,this}},c_=new Nt,no=new Ss,vh=new tn,h_=new F,bh=new F,Sh=new F,Mh=new F,Ap=new F,wh=new F,u_=new F,Th=new F,de=class extends sn{constructor(t=new Ae,e=new Ui){super(),this.isMesh=!0,this.type="Mesh",this.geometry=t,this.material=e,this.morphTargetDictionary=void 0,this.morphTargetInfluences=void 0,this.count=1,this.updateMorphTargets()}copy(t,e){return super.copy(t,e),t.morphTargetInfluences!==void 0?this.morphTargetInfluences=t.morphTargetInfluences.slice():this.morphTargetInfluences=void 0,t.morphTargetDictionary!==void 0?this.morphTargetDictionary=Object.assign({},t.morphTargetDictionary):this.morphTargetDictionary=void 0,this.material=Array.isArray(t.material)?t.material.slice():t.material,this.geometry=t.geometry,this}updateMorphTargets(){let e=this.geometry.morphAttributes,n=Object.keys(e);if(n.length>0){let i=e[n[0]];if(i!==void 0){this.morphTargetInfluences=[],this.morphTargetDictionary={};for(let r=0,o=i.length;r<o;r++){let a=i[r].name||String(r);this.morphTargetInfluences.push(0),this.morphTargetDictionary[a]=r}}}}getVertexPosition(t,e){let n=this.geometry,i=n.attributes.position,r=n.morphAttributes.position,o=n.morphTargetsRelative;e.fromBufferAttribute(i,t);let a=this.morphTargetInfluences;if(r&&a){wh.set(0,0,0);for(let l=0,c=r.length;l<c;l++){let h=a[l],u=r[l];h!==0&&(Ap.fromBufferAttribute(u,t),o?wh.addScaledVector(Ap,h):wh.addScaledVector(Ap.sub(e),h))}e.add(wh)}return e}intersectsFrustum(t){return t.intersectsObject(this)}raycast(t,e){let n=this.geometry,i=this.material,r=this.matrixWorld;i!==void 0&&(n.boundingSphere===null&&n.computeBoundingSphere(),vh.copy(n.boundingSphere),vh.applyMatrix4(r),no.copy(t.ray).recast(t.near),!(vh.containsPoint(no.origin)===!1&&(no.intersectSphere(vh,h_)===null||no.origin.distanceToSquared(h_)>(t.far-t.near)**2))&&(c_.copy(r).invert(),no.copy(t.ray).applyMatrix4(c_),!(n.boundingBox!==null&&no.intersectsBox(n.boundingBox)===!1)&&this._computeIntersections(t,e,no)))}_computeIntersections(t,e,n){let i,r=this.geometry,o=this.material,a=r.index,l=r.attributes.position,c=r.attributes.uv,h=r.attributes.uv1,u=r.attributes.normal,d=r.groups,f=r.drawRange;if(a!==null)if(Array.isArray(o))for(let m=0,y=d.length;m<y;m++){let p=d[m],g=o[p.materialIndex],_=Math.max(p.start,f.start),w=Math.min(a.count,Math.min(p.start+p.count,f.start+f.count));for(let v=_,A=w;v<A;v+=3){let S=a.getX(v),x=a.getX(v+1),M=a.getX(v+2);i=Ah(this,g,t,n,c,h,u,S,x,M),i&&(i.faceIndex=Math.floor(v/3),i.face.materialIndex=p.materialIndex,e.push(i))}}else{let m=Math.max(0,f.start),y=Math.min(a.count,f.start+f.count);for(let p=m,g=y;p<g;p+=3){let _=a.getX(p),w=a.getX(p+1),v=a.getX(p+2);i=Ah(this,o,t,n,c,h,u,_,w,v),i&&(i.faceIndex=Math.floor(p/3),e.push(i))}}else if(l!==void 0)if(Array.isArray(o))for(let m=0,y=d.length;m<y;m++){let p=d[m],g=o[p.materialIndex],_=Math.max(p.start,f.start),w=Math.min(l.count,Math.min(p.start+p.count,f.start+f.count));for(let v=_,A=w;v<A;v+=3){let S=v,x=v+1,M=v+2;i=Ah(this,g,t,n,c,h,u,S,x,M),i&&(i.faceIndex=Math.floor(v/3),i.face.materialIndex=p.materialIndex,e.push(i))}}else{let m=Math.max(0,f.start),y=Math.min(l.count,f.start+f.count);for(let p=m,g=y;p<g;p+=3){let _=p,w=p+1,v=p+2;i=Ah(this,o,t,n,c,h,u,_,w,v),i&&(i.faceIndex=Math.floor(p/3),e.push(i))}}}};function CT(s,t,e,n,i,r,o,a){let l;if(t.side===jn?l=n.intersectTriangle(o,r,i,!0,a):l=n.intersectTriangle(i,r,o,t.side===Es,a),l===null)return null;Th.copy(a),Th.applyMatrix4(s.matrixWorld);let c=e.ray.origin.distanceTo(Th);return c<e.near||c>e.far?null:{distance:c,point:Th.clone(),object:s}}function Ah(s,t,e,n,i,r,o,a,l,c){s.getVertexPosition(a,bh),s.getVertexPosition(l,Sh),s.getVertexPosition(c,Mh);let h=CT(s,t,e,n,bh,Sh,Mh,u_);if(h){let u=new F;as.getBarycoord(u_,bh,Sh,Mh,u),i&&(h.uv=as.getInterpolatedAttribute(i,a,l,c,u,new Xt)),r&&(h.uv1=as.getInterpolatedAttribute(r,a,l,c,u,new Xt)),o&&(h.normal=as.getInterpolatedAttribute(o,a,l,c,u,new F),h.normal.dot(n.direction)>0&&h.normal.multiplyScalar(-1));let d={a,b:l,c,normal:new F,materialIndex:0};as.getNormal(bh,Sh,Mh,d.normal),h.face=d,h.barycoord=u}return h}var cl=new Se,d_=new Se,f_=new Se,RT=new Se,p_=new Nt,Eh=new F,Ep=new tn,m_=new Nt,Cp=new Ss,Tl=class extends de{constructor(t,e){super(t,e),this.isSkinnedMesh=!0,this.type="SkinnedMesh",this.bindMode=Np,this.bindMatrix=new Nt,this.bindMatrixInverse=new Nt,this.boundingBox=null,this.boundingSphere=null}computeBoundingBox(){let t=this.geometry;this.boundingBox===null&&(this.boundingBox=new fn),this.boundingBox.makeEmpty();let e=t.getAttribute("position");for(let n=0;n<e.count;n++)this.getVertexPosition(n,Eh),this.boundingBox.expandByPoint(Eh)}computeBoundingSphere(){let t=this.geometry;this.boundingSphere===null&&(this.boundingSphere=new tn),this.boundingSphere.makeEmpty();let e=t.getAttribute("position");for(let n=0;n<e.count;n++)this.getVertexPosition(n,Eh),this.boundingSphere.expandByPoint(Eh)}copy(t,e){return super.copy(t,e),this.bindMode=t.bindMode,this.bindMatrix.copy(t.bindMatrix),this.bindMatrixInverse.copy(t.bindMatrixInverse),this.skeleton=t.skeleton,this.boundingBox=t.boundingBox!==null?t.boundingBox.clone():null,this.boundingSphere=t.boundingSphere!==null?t.boundingSphere.clone():null,this}raycast(t,e){let n=this.material,i=this.matrixWorld;n!==void 0&&(this.boundingSphere===null&&this.computeBoundingSphere(),Ep.copy(this.boundingSphere),Ep.applyMatrix4(i),t.ray.intersectsSphere(Ep)!==!1&&(m_.copy(i).invert(),Cp.copy(t.ray).applyMatrix4(m_),!(this.boundingBox!==null&&Cp.intersectsBox(this.boundingBox)===!1)&&this._computeIntersections(t,e,Cp)))}getVertexPosition(t,e){return super.getVertexPosition(t,e),this.applyBoneTransform(t,e),e}bind(t,e){this.skeleton=t,e===void 0&&(this.updateMatrixWorld(!0),this.skeleton.calculateInverses(),e=this.matrixWorld),this.bindMatrix.copy(e),this.bindMatrixInverse.copy(e).invert()}pose(){this.skeleton.pose()}normalizeSkinWeights(){let t=new Se,e=this.geometry.attributes.skinWeight;for(let n=0,i=e.count;n<i;n++){t.fromBufferAttribute(e,n);let r=1/t.manhattanLength();r!==1/0?t.multiplyScalar(r):t.set(1,0,0,0),e.setXYZW(n,t.x,t.y,t.z,t.w)}}updateMatrixWorld(t){super.updateMatrixWorld(t),this.bindMode===Np?this.bindMatrixInverse.copy(this.matrixWorld).invert():this.bindMode===ux?this.bindMatrixInverse.copy(this.bindMatrix).invert():Yt("SkinnedMesh: Unrecognized bindMode: "+this.bindMode)}applyBoneTransform(t,e){let n=this.skeleton,i=this.geometry;d_.fromBufferAttribute(i.attributes.skinIndex,t),f_.fromBufferAttribute(i.attributes.skinWeight,t),e.isVector4?(cl.copy(e),e.set(0,0,0,0)):(cl.set(e.x,e.y,e.z,1),e.set(0,0,0)),cl.applyMatrix4(this.bindMatrix);for(let r=0;r<4;r++){let o=f_.getComponent(r);if(o!==0){let a=d_.getComponent(r);p_.multiplyMatrices(n.bones[a].matrixWorld,n.boneInverses[a]),e.addScaledVector(RT.copy(cl).applyMatrix4(p_),o)}}return e.isVector4&&(e.w=cl.w),e.applyMatrix4(this.bindMatrixInverse)}},ya=class extends sn{constructor(){super(),this.isBone=!0,this.type="Bone"}},Ar=class extends mi{constructor(t=null,e=1,n=1,i,r,o,a,l,c=kn,h=kn,u,d){super(null,o,a,l,c,h,i,r,u,d),this.isDataTexture=!0,this.image={data:t,width:e,height:n},this.generateMipmaps=!1,this.flipY=!1,this.unpackAlignment=1}},g_=new Nt,PT=new Nt,Al=class s{constructor(t=[],e=[]){this.uuid=Rs(),this.bones=t.slice(0),this.boneInverses=e,this.boneMatrices=null,this.previousBoneMatrices=null,this.boneTexture=null,this.previousBoneTexture=null,this.init()}init(){let t=this.bones,e=this.boneInverses;if(this.boneMatrices=new Float32Array(t.length*16),e.length===0)this.calculateInverses();else if(t.length!==e.length){Yt("Skeleton: Number of inverse bone matrices does not match amount of bones."),this.boneInverses=[];for(let n=0,i=this.bones.length;n<i;n++)this.boneInverses.push(new Nt)}}calculateInverses(){this.boneInverses.length=0;for(let t=0,e=this.bones.length;t<e;t++){let n=new Nt;this.bones[t]&&n.copy(this.bones[t].matrixWorld).invert(),this.boneInverses.push(n)}}pose(){for(let t=0,e=this.bones.length;t<e;t++){let n=this.bones[t];n&&n.matrixWorld.copy(this.boneInverses[t]).invert()}for(let t=0,e=this.bones.length;t<e;t++){let n=this.bones[t];n&&(n.parent&&n.parent.isBone?(n.matrix.copy(n.parent.matrixWorld).invert(),n.matrix.multiply(n.matrixWorld)):n.matrix.copy(n.matrixWorld),n.matrix.decompose(n.position,n.quaternion,n.scale))}}update(){let t=this.bones,e=this.boneInverses,n=this.boneMatrices,i=this.boneTexture;for(let r=0,o=t.length;r<o;r++){let a=t[r]?t[r].matrixWorld:PT;g_.multiplyMatrices(a,e[r]),g_.toArray(n,r*16)}i!==null&&(i.needsUpdate=!0)}clone(){return new s(this.bones,this.boneInverses)}computeBoneTexture(){let t=Math.sqrt(this.bones.length*4);t=Math.ceil(t/4)*4,t=Math.max(t,4);let e=new Float32Array(t*t*4);e.set(this.boneMatrices);let n=new Ar(e,t,t,Ji,ki);return n.needsUpdate=!0,this.boneMatrices=e,this.boneTexture=n,this}getBoneByName(t){for(let e=0,n=this.bones.length;e<n;e++){let i=this.bones[e];if(i.name===t)return i}}dispose(){this.boneTexture!==null&&(this.boneTexture.dispose(),this.boneTexture=null),this.previousBoneTexture!==null&&(this.previousBoneTexture.dispose(),this.previousBoneTexture=null)}fromJSON(t,e){this.uuid=t.uuid;for(let n=0,i=t.bones.length;n<i;n++){let r=t.bones[n],o=e[r];o===void 0&&(Yt("Skeleton: No bone found with UUID:",r),o=new ya),this.bones.push(o),this.boneInverses.push(new Nt().fromArray(t.boneInverses[n]))}return this.init(),this}toJSON(){let t={metadata:{version:4.7,type:"Skeleton",generator:"Skeleton.toJSON"},bones:[],boneInverses:[]};t.uuid=this.uuid;let e=this.bones,n=this.boneInverses;for(let i=0,r=e.length;i<r;i++){let o=e[i];t.bones.push(o.uuid);let a=n[i];t.boneInverses.push(a.toArray())}return t}},El=class extends hn{constructor(t,e,n,i=1){super(t,e,n),this.isInstancedBufferAttribute=!0,this.meshPerAttribute=i}copy(t){return super.copy(t),this.meshPerAttribute=t.meshPerAttribute,this}toJSON(){let t=super.toJSON();return t.meshPerAttribute=this.meshPerAttribute,t.isInstancedBufferAttribute=!0,t}},ea=new Nt,y_=new Nt,Ch=[],__=new fn,LT=new Nt,hl=new de,ul=new tn,Cl=class extends de{constructor(t,e,n){super(t,e),this.isInstancedMesh=!0,this.instanceMatrix=new El(new Float32Array(n*16),16),this.instanceColor=null,this.morphTexture=null,this.count=n,this.boundingBox=null,this.boundingSphere=null;for(let i=0;i<n;i++)this.setMatrixAt(i,LT)}computeBoundingBox(){let t=this.geometry,e=this.count;this.boundingBox===null&&(this.boundingBox=new fn),t.boundingBox===null&&t.computeBoundingBox(),this.boundingBox.makeEmpty();for(let n=0;n<e;n++)this.getMatrixAt(n,ea),__.copy(t.boundingBox).applyMatrix4(ea),this.boundingBox.union(__)}computeBoundingSphere(){let t=this.geometry,e=this.count;this.boundingSphere===null&&(this.boundingSphere=new tn),t.boundingSphere===null&&t.computeBoundingSphere(),this.boundingSphere.makeEmpty();for(let n=0;n<e;n++)this.getMatrixAt(n,ea),ul.copy(t.boundingSphere).applyMatrix4(ea),this.boundingSphere.union(ul)}copy(t,e){return super.copy(t,e),this.instanceMatrix.copy(t.instanceMatrix),this.morphTexture=t.morphTexture!==null?t.morphTexture.clone():null,this.instanceColor=t.instanceColor!==null?t.instanceColor.clone():null,this.count=t.count,this.boundingBox=t.boundingBox!==null?t.boundingBox.clone():null,this.boundingSphere=t.boundingSphere!==null?t.boundingSphere.clone():null,this}getColorAt(t,e){return this.instanceColor===null?e.setRGB(1,1,1):e.fromArray(this.instanceColor.array,t*3)}getMatrixAt(t,e){return e.fromArray(this.instanceMatrix.array,t*16)}getMorphAt(t,e){let n=e.morphTargetInfluences,i=this.morphTexture.source.data.data,r=n.length+1,o=t*r+1;for(let a=0;a<n.length;a++)n[a]=i[o+a]}raycast(t,e){let n=this.matrixWorld,i=this.count;if(hl.geometry=this.geometry,hl.material=this.material,hl.material!==void 0&&(this.boundingSphere===null&&this.computeBoundingSphere(),ul.copy(this.boundingSphere),ul.applyMatrix4(n),t.ray.intersectsSphere(ul)!==!1))for(let r=0;r<i;r++){this.getMatrixAt(r,ea),y_.multiplyMatrices(n,ea),hl.matrixWorld=y_,hl.raycast(t,Ch);for(let o=0,a=Ch.length;o<a;o++){let l=Ch[o];l.instanceId=r,l.object=this,e.push(l)}Ch.length=0}}setColorAt(t,e){return this.instanceColor===null&&(this.instanceColor=new El(new Float32Array(this.instanceMatrix.count*3).fill(1),3)),e.toArray(this.instanceColor.array,t*3),this}setMatrixAt(t,e){return e.toArray(this.instanceMatrix.array,t*16),this}setMorphAt(t,e){let n=e.morphTargetInfluences,i=n.length+1;this.morphTexture===null&&(this.morphTexture=new Ar(new Float32Array(i*this.count),i,this.count,Su,ki));let r=this.morphTexture.source.data.data,o=0;for(let c=0;c<n.length;c++)o+=n[c];let a=this.geometry.morphTargetsRelative?1:1-o,l=i*t;return r[l]=a,r.set(n,l+1),this}updateMorphTargets(){}dispose(){super.dispose(),this.instanceMatrix.dispose(),this.instanceColor!==null&&this.instanceColor.dispose(),this.morphTexture!==null&&(this.morphTexture.dispose(),this.morphTexture=null)}},io=new tn,IT=new Xt(.5,.5),Rh=new F,Er=class{constructor(t=new Oi,e=new Oi,n=new Oi,i=new Oi,r=new Oi,o=new Oi){this.planes=[t,e,n,i,r,o]}set(t,e,n,i,r,o){let a=this.planes;return a[0].copy(t),a[1].copy(e),a[2].copy(n),a[3].copy(i),a[4].copy(r),a[5].copy(o),this}copy(t){let e=this.planes;for(let n=0;n<6;n++)e[n].copy(t.planes[n]);return this}setFromProjectionMatrix(t,e=ji,n=!1){let i=this.planes,r=t.elements,o=r[0],a=r[1],l=r[2],c=r[3],h=r[4],u=r[5],d=r[6],f=r[7],m=r[8],y=r[9],p=r[10],g=r[11],_=r[12],w=r[13],v=r[14],A=r[15];if(i[0].setComponents(c-o,f-h,g-m,A-_).normalize(),i[1].setComponents(c+o,f+h,g+m,A+_).normalize(),i[2].setComponents(c+a,f+u,g+y,A+w).normalize(),i[3].setComponents(c-a,f-u,g-y,A-w).normalize(),n)i[4].setComponents(l,d,p,v).normalize(),i[5].setComponents(c-l,f-d,g-p,A-v).normalize();else if(i[4].setComponents(c-l,f-d,g-p,A-v).normalize(),e===ji)i[5].setComponents(c+l,f+d,g+p,A+v).normalize();else if(e===ua)i[5].setComponents(l,d,p,v).normalize();else throw new Error("THREE.Frustum.setFromProjectionMatrix(): Invalid coordinate system: "+e);return this}intersectsObject(t){if(t.boundingSphere!==void 0)t.boundingSphere===null&&t.computeBoundingSphere(),io.copy(t.boundingSphere).applyMatrix4(t.matrixWorld);else{let e=t.geometry;e.boundingSphere===null&&e.computeBoundingSphere(),io.copy(e.boundingSphere).applyMatrix4(t.matrixWorld)}return this.intersectsSphere(io)}intersectsSprite(t){io.center.set(0,0,0);let e=IT.distanceTo(t.center);return io.radius=.7071067811865476+e,io.applyMatrix4(t.matrixWorld),this.intersectsSphere(io)}intersectsSphere(t){let e=this.planes,n=t.center,i=-t.radius;for(let r=0;r<6;r++)if(e[r].distanceToPoint(n)<i)return!1;return!0}intersectsBox(t){let e=this.planes;for(let n=0;n<6;n++){let i=e[n];if(Rh.x=i.normal.x>0?t.max.x:t.min.x,Rh.y=i.normal.y>0?t.max.y:t.min.y,Rh.z=i.normal.z>0?t.max.z:t.min.z,i.distanceToPoint(Rh)<0)return!1}return!0}containsPoint(t){let e=this.planes;for(let n=0;n<6;n++)if(e[n].distanceToPoint(t)<0)return!1;return!0}clone(){return new this.constructor().copy(this)}},x_=new Nt,iu=class s{constructor(){this.coordinateSystem=ji,this._frustums=[],this._count=0}setFromArrayCamera(t){let e=t.cameras,n=this._frustums;for(let i=0;i<e.length;i++){let r=e[i];x_.multiplyMatrices(r.projectionMatrix,r.matrixWorldInverse),n[i]===void 0&&(n[i]=new Er),n[i].setFromProjectionMatrix(x_,r.coordinateSystem,r.reversedDepth)}return this._count=e.length,this}getFrustum(t){return this._frustums[t]}intersectsObject(t){let e=this._frustums;for(let n=0;n<this._count;n++)if(e[n].intersectsObject(t))return!0;return!1}intersectsSprite(t){let e=this._frustums;for(let n=0;n<this._count;n++)if(e[n].intersectsSprite(t))return!0;return!1}intersectsSphere(t){let e=this._frustums;for(let n=0;n<this._count;n++)if(e[n].intersectsSphere(t))return!0;return!1}intersectsBox(t){let e=this._frustums;for(let n=0;n<this._count;n++)if(e[n].intersectsBox(t))return!0;return!1}containsPoint(t){let e=this._frustums;for(let n=0;n<this._count;n++)if(e[n].containsPoint(t))return!0;return!1}copy(t){this.coordinateSystem=t.coordinateSystem;let e=this._frustums,n=t._frustums;for(let i=0;i<t._count;i++)e[i]===void 0&&(e[i]=new Er),e[i].copy(n[i]);return this._count=t._count,this}clone(){return new s().copy(this)}};var Xn=class extends gi{constructor(t){super(),this.isLineBasicMaterial=!0,this.type="LineBasicMaterial",this.color=new Rt(16777215),this.map=null,this.linewidth=1,this.linecap="round",this.linejoin="round",this.fog=!0,this.setValues(t)}copy(t){return super.copy(t),this.color.copy(t.color),this.map=t.map,this.linewidth=t.linewidth,this.linecap=t.linecap,this.linejoin=t.linejoin,this.fog=t.fog,this}},su=new F,ru=new F,v_=new Nt,dl=new Ss,Ph=new tn,Rp=new F,b_=new F,Cr=class extends sn{constructor(t=new Ae,e=new Xn){super(),this.isLine=!0,this.type="Line",this.geometry=t,this.material=e,this.morphTargetDictionary=void 0,this.morphTargetInfluences=void 0,this.updateMorphTargets()}copy(t,e){return super.copy(t,e),t.morphTargetInfluences!==void 0?this.morphTargetInfluences=t.morphTargetInfluences.slice():this.morphTargetInfluences=void 0,t.morphTargetDictionary!==void 0?this.morphTargetDictionary=Object.assign({},t.morphTargetDictionary):this.morphTargetDictionary=void 0,this.material=Array.isArray(t.material)?t.material.slice():t.material,this.geometry=t.geometry,this}computeLineDistances(){let t=this.geometry;if(t.index===null){let e=t.attributes.position,n=[0];for(let i=1,r=e.count;i<r;i++)su.fromBufferAttribute(e,i-1),ru.fromBufferAttribute(e,i),n[i]=n[i-1],n[i]+=su.distanceTo(ru);t.setAttribute("lineDistance",new $t(n,1))}else Yt("Line.computeLineDistances(): Computation only possible with non-indexed BufferGeometry.");return this}intersectsFrustum(t){return t.intersectsObject(this)}raycast(t,e){let n=this.geometry,i=this.matrixWorld,r=t.params.Line.threshold,o=n.drawRange;if(n.boundingSphere===null&&n.computeBoundingSphere(),Ph.copy(n.boundingSphere),Ph.applyMatrix4(i),Ph.radius+=r,t.ray.intersectsSphere(Ph)===!1)return;v_.copy(i).invert(),dl.copy(t.ray).applyMatrix4(v_);let a=r/((this.scale.x+this.scale.y+this.scale.z)/3),l=a*a,c=this.isLineSegments?2:1,h=n.index,d=n.attributes.position;if(h!==null){let f=Math.max(0,o.start),m=Math.min(h.count,o.start+o.count);for(let y=f,p=m-1;y<p;y+=c){let g=h.getX(y),_=h.getX(y+1),w=Lh(this,t,dl,l,g,_,y);w&&e.push(w)}if(this.isLineLoop){let y=h.getX(m-1),p=h.getX(f),g=Lh(this,t,dl,l,y,p,m-1);g&&e.push(g)}}else{let f=Math.max(0,o.start),m=Math.min(d.count,o.start+o.count);for(let y=f,p=m-1;y<p;y+=c){let g=Lh(this,t,dl,l,y,y+1,y);g&&e.push(g)}if(this.isLineLoop){let y=Lh(this,t,dl,l,m-1,f,m-1);y&&e.push(y)}}}updateMorphTargets(){let e=this.geometry.morphAttributes,n=Object.keys(e);if(n.length>0){let i=e[n[0]];if(i!==void 0){this.morphTargetInfluences=[],this.morphTargetDictionary={};for(let r=0,o=i.length;r<o;r++){let a=i[r].name||String(r);this.morphTargetInfluences.push(0),this.morphTargetDictionary[a]=r}}}}};function Lh(s,t,e,n,i,r,o){let a=s.geometry.attributes.position;if(su.fromBufferAttribute(a,i),ru.fromBufferAttribute(a,r),e.distanceSqToSegment(su,ru,Rp,b_)>n)return;Rp.applyMatrix4(s.matrixWorld);let c=t.ray.origin.distanceTo(Rp);if(!(c<t.near||c>t.far))return{distance:c,point:b_.clone().applyMatrix4(s.matrixWorld),index:o,face:null,faceIndex:null,barycoord:null,object:s}}var S_=new F,M_=new F,Bi=class extends Cr{constructor(t,e){super(t,e),this.isLineSegments=!0,this.type="LineSegments"}computeLineDistances(){let t=this.geometry;if(t.index===null){let e=t.attributes.position,n=[];for(let i=0,r=e.count;i<r;i+=2)S_.fromBufferAttribute(e,i),M_.fromBufferAttribute(e,i+1),n[i]=i===0?0:n[i-1],n[i+1]=n[i]+S_.distanceTo(M_);t.setAttribute("lineDistance",new $t(n,1))}else Yt("LineSegments.computeLineDistances(): Computation only possible with non-indexed BufferGeometry.");return this}};var cs=class extends gi{constructor(t){super(),this.isPointsMaterial=!0,this.type="PointsMaterial",this.color=new Rt(16777215),this.map=null,this.alphaMap=null,this.size=1,this.sizeAttenuation=!0,this.fog=!0,this.setValues(t)}copy(t){return super.copy(t),this.color.copy(t.color),this.map=t.map,this.alphaMap=t.alphaMap,this.size=t.size,this.sizeAttenuation=t.sizeAttenuation,this.fog=t.fog,this}},w_=new Nt,Up=new Ss,Ih=new tn,Nh=new F,Zs=class extends sn{constructor(t=new Ae,e=new cs){super(),this.isPoints=!0,this.type="Points",this.geometry=t,this.material=e,this.morphTargetDictionary=void 0,this.morphTargetInfluences=void 0,this.updateMorphTargets()}copy(t,e){return super.copy(t,e),t.morphTargetInfluences!==void 0?this.morphTargetInfluences=t.morphTargetInfluences.slice():this.morphTargetInfluences=void 0,t.morphTargetDictionary!==void 0?this.morphTargetDictionary=Object.assign({},t.morphTargetDictionary):this.morphTargetDictionary=void 0,this.material=Array.isArray(t.material)?t.material.slice():t.material,this.geometry=t.geometry,this}intersectsFrustum(t){return t.intersectsObject(this)}raycast(t,e){let n=this.geometry,i=this.matrixWorld,r=t.params.Points.threshold,o=n.drawRange;if(n.boundingSphere===null&&n.computeBoundingSphere(),Ih.copy(n.boundingSphere),Ih.applyMatrix4(i),Ih.radius+=r,t.ray.intersectsSphere(Ih)===!1)return;w_.copy(i).invert(),Up.copy(t.ray).applyMatrix4(w_);let a=r/((this.scale.x+this.scale.y+this.scale.z)/3),l=a*a,c=n.index,u=n.attributes.position;if(c!==null){let d=Math.max(0,o.start),f=Math.min(c.count,o.start+o.count);for(let m=d,y=f;m<y;m++){let p=c.getX(m);Nh.fromBufferAttribute(u,p),T_(Nh,p,l,i,t,e,this)}}else{let d=Math.max(0,o.start),f=Math.min(u.count,o.start+o.count);for(let m=d,y=f;m<y;m++)Nh.fromBufferAttribute(u,m),T_(Nh,m,l,i,t,e,this)}}updateMorphTargets(){let e=this.geometry.morphAttributes,n=Object.keys(e);if(n.length>0){let i=e[n[0]];if(i!==void 0){this.morphTargetInfluences=[],this.morphTargetDictionary={};for(let r=0,o=i.length;r<o;r++){let a=i[r].name||String(r);this.morphTargetInfluences.push(0),this.morphTargetDictionary[a]=r}}}}};function T_(s,t,e,n,i,r,o){let a=Up.distanceSqToPoint(s);if(a<e){let l=new F;Up.closestPointToPoint(s,l),l.applyMatrix4(n);let c=i.ray.origin.distanceTo(l);if(c<i.near||c>i.far)return;r.push({distance:c,distanceToRay:Math.sqrt(a),point:l,index:t,face:null,faceIndex:null,barycoord:null,object:o})}}var Rl=class extends mi{constructor(t=[],e=_o,n,i,r,o,a,l,c,h){super(t,e,n,i,r,o,a,l,c,h),this.isCubeTexture=!0,this.flipY=!1}get images(){return this.image}set images(t){this.image=t}};var Qs=class extends mi{constructor(t,e,n=us,i,r,o,a=kn,l=kn,c,h=Ks,u=1){if(h!==Ks&&h!==sr)throw new Error("THREE.DepthTexture: format must be either THREE.DepthFormat or THREE.DepthStencilFormat");let d={width:t,height:e,depth:u};super(d,i,r,o,a,l,h,n,c),this.isDepthTexture=!0,this.flipY=!1,this.generateMipmaps=!1,this.compareFunction=null}copy(t){return super.copy(t),this.source=new pa(Object.assign({},t.image)),this.compareFunction=t.compareFunction,this}toJSON(t){let e=super.toJSON(t);return e.compareFunction=this.compareFunction,e}},Pl=class extends Qs{constructor(t,e=us,n=_o,i,r,o=kn,a=kn,l,c=Ks){let h={width:t,height:t,depth:1},u=[h,h,h,h,h,h];super(t,t,e,n,i,r,o,a,l,c),this.image=u,this.isCubeDepthTexture=!0,this.isCubeTexture=!0}get images(){return this.image}set images(t){this.image=t}},Ll=class extends mi{constructor(t=null){super(),this.sourceTexture=t,this.isExternalTexture=!0}copy(t){return super.copy(t),this.sourceTexture=t.sourceTexture,this}},Ms=class s extends Ae{constructor(t=1,e=1,n=1,i=1,r=1,o=1){super(),this.type="BoxGeometry",this.parameters={width:t,height:e,depth:n,widthSegments:i,heightSegments:r,depthSegments:o};let a=this;i=Math.floor(i),r=Math.floor(r),o=Math.floor(o);let l=[],c=[],h=[],u=[],d=0,f=0;m("z","y","x",-1,-1,n,e,t,o,r,0),m("z","y","x",1,-1,n,e,-t,o,r,1),m("x","z","y",1,1,t,n,e,i,o,2),m("x","z","y",1,-1,t,n,-e,i,o,3),m("x","y","z",1,-1,t,e,n,i,r,4),m("x","y","z",-1,-1,t,e,-n,i,r,5),this.setIndex(l),this.setAttribute("position",new $t(c,3)),this.setAttribute("normal",new $t(h,3)),this.setAttribute("uv",new $t(u,2));function m(y,p,g,_,w,v,A,S,x,M,L){let P=v/x,R=A/M,O=v/2,k=A/2,N=S/2,W=x+1,z=M+1,H=0,it=0,Y=new F;for(let K=0;K<z;K++){let tt=K*R-k;for(let ht=0;ht<W;ht++){let st=ht*P-O;Y[y]=st*_,Y[p]=tt*w,Y[g]=N,c.push(Y.x,Y.y,Y.z),Y[y]=0,Y[p]=0,Y[g]=S>0?1:-1,h.push(Y.x,Y.y,Y.z),u.push(ht/x),u.push(1-K/M),H+=1}}for(let K=0;K<M;K++)for(let tt=0;tt<x;tt++){let ht=d+tt+W*K,st=d+tt+W*(K+1),j=d+(tt+1)+W*(K+1),rt=d+(tt+1)+W*K;l.push(ht,st,rt),l.push(st,j,rt),it+=6}a.addGroup(f,it,L),f+=it,d+=H}}copy(t){return super.copy(t),this.parameters=Object.assign({},t.parameters),this}static fromJSON(t){return new s(t.width,t.height,t.depth,t.widthSegments,t.heightSegments,t.depthSegments)}},Il=class s extends Ae{constructor(t=1,e=1,n=4,i=8,r=1){super(),this.type="CapsuleGeometry",this.parameters={radius:t,height:e,capSegments:n,radialSegments:i,heightSegments:r},e=Math.max(0,e),n=Math.max(1,Math.floor(n)),i=Math.max(3,Math.floor(i)),r=Math.max(1,Math.floor(r));let o=[],a=[],l=[],c=[],h=e/2,u=Math.PI/2*t,d=e,f=2*u+d,m=n*2+r,y=i+1,p=new F,g=new F;for(let _=0;_<=m;_++){let w=0,v=0,A=0,S=0;if(_<=n){let L=_/n,P=L*Math.PI/2;v=-h-t*Math.cos(P),A=t*Math.sin(P),S=-t*Math.cos(P),w=L*u}else if(_<=n+r){let L=(_-n)/r;v=-h+L*e,A=t,S=0,w=u+L*d}else{let L=(_-n-r)/n,P=L*Math.PI/2;v=h+t*Math.sin(P),A=t*Math.cos(P),S=t*Math.sin(P),w=u+d+L*u}let x=Math.max(0,Math.min(1,w/f)),M=0;_===0?M=.5/i:_===m&&(M=-.5/i);for(let L=0;L<=i;L++){let P=L/i,R=P*Math.PI*2,O=Math.sin(R),k=Math.cos(R);g.x=-A*k,g.y=v,g.z=A*O,a.push(g.x,g.y,g.z),p.set(-A*k,S,A*O),p.normalize(),l.push(p.x,p.y,p.z),c.push(P+M,x)}if(_>0){let L=(_-1)*y;for(let P=0;P<i;P++){let R=L+P,O=L+P+1,k=_*y+P,N=_*y+P+1;o.push(R,O,k),o.push(O,N,k)}}}this.setIndex(o),this.setAttribute("position",new $t(a,3)),this.setAttribute("normal",new $t(l,3)),this.setAttribute("uv",new $t(c,2))}copy(t){return super.copy(t),this.parameters=Object.assign({},t.parameters),this}static fromJSON(t){return new s(t.radius,t.height,t.capSegments,t.radialSegments,t.heightSegments)}},Nl=class s extends Ae{constructor(t=1,e=32,n=0,i=Math.PI*2){super(),this.type="CircleGeometry",this.parameters={radius:t,segments:e,thetaStart:n,thetaLength:i},e=Math.max(3,e);let r=[],o=[],a=[],l=[],c=new F,h=new Xt;o.push(0,0,0),a.push(0,0,1),l.push(.5,.5);for(let u=0,d=3;u<=e;u++,d+=3){let f=n+u/e*i;c.x=t*Math.cos(f),c.y=t*Math.sin(f),o.push(c.x,c.y,c.z),a.push(0,0,1),h.x=(o[d]/t+1)/2,h.y=(o[d+1]/t+1)/2,l.push(h.x,h.y)}for(let u=1;u<=e;u++)r.push(u,u+1,0);this.setIndex(r),this.setAttribute("position",new $t(o,3)),this.setAttribute("normal",new $t(a,3)),this.setAttribute("uv",new $t(l,2))}copy(t){return super.copy(t),this.parameters=Object.assign({},t.parameters),this}static fromJSON(t){return new s(t.radius,t.segments,t.thetaStart,t.thetaLength)}},tr=class s extends Ae{constructor(t=1,e=1,n=1,i=32,r=1,o=!1,a=0,l=Math.PI*2){super(),this.type="CylinderGeometry",this.parameters={radiusTop:t,radiusBottom:e,height:n,radialSegments:i,heightSegments:r,openEnded:o,thetaStart:a,thetaLength:l};let c=this;i=Math.floor(i),r=Math.floor(r);let h=[],u=[],d=[],f=[],m=0,y=[],p=n/2,g=0;_(),o===!1&&(t>0&&w(!0),e>0&&w(!1)),this.setIndex(h),this.setAttribute("position",new $t(u,3)),this.setAttribute("normal",new $t(d,3)),this.setAttribute("uv",new $t(f,2));function _(){let v=new F,A=new F,S=0,x=(e-t)/n;for(let M=0;M<=r;M++){let L=[],P=M/r,R=P*(e-t)+t;for(let O=0;O<=i;O++){let k=O/i,N=k*l+a,W=Math.sin(N),z=Math.cos(N);A.x=R*W,A.y=-P*n+p,A.z=R*z,u.push(A.x,A.y,A.z),v.set(W,x,z).normalize(),d.push(v.x,v.y,v.z),f.push(k,1-P),L.push(m++)}y.push(L)}for(let M=0;M<i;M++)for(let L=0;L<r;L++){let P=y[L][M],R=y[L+1][M],O=y[L+1][M+1],k=y[L][M+1];(t>0||L!==0)&&(h.push(P,R,k),S+=3),(e>0||L!==r-1)&&(h.push(R,O,k),S+=3)}c.addGroup(g,S,0),g+=S}function w(v){let A=m,S=new Xt,x=new F,M=0,L=v===!0?t:e,P=v===!0?1:-1;for(let O=1;O<=i;O++)u.push(0,p*P,0),d.push(0,P,0),f.push(.5,.5),m++;let R=m;for(let O=0;O<=i;O++){let N=O/i*l+a,W=Math.cos(N),z=Math.sin(N);x.x=L*z,x.y=p*P,x.z=L*W,u.push(x.x,x.y,x.z),d.push(0,P,0),S.x=W*.5+.5,S.y=z*.5*P+.5,f.push(S.x,S.y),m++}for(let O=0;O<i;O++){let k=A+O,N=R+O;v===!0?h.push(N,N+1,k):h.push(N+1,N,k),M+=3}c.addGroup(g,M,v===!0?1:2),g+=M}}copy(t){return super.copy(t),this.parameters=Object.assign({},t.parameters),this}static fromJSON(t){return new s(t.radiusTop,t.radiusBottom,t.height,t.radialSegments,t.heightSegments,t.openEnded,t.thetaStart,t.thetaLength)}};var Dh=new F,Oh=new F,Pp=new F,Fh=new as,oo=class extends Ae{constructor(t=null,e=1){if(super(),this.type="EdgesGeometry",this.parameters={geometry:t,thresholdAngle:e},t!==null){let i=Math.pow(10,4),r=Math.cos(aa*e),o=t.getIndex(),a=t.getAttribute("position"),l=o?o.count:a.count,c=[0,0,0],h=["a","b","c"],u=new Array(3),d=new Map,f=[];for(let m=0;m<l;m+=3){o?(c[0]=o.getX(m),c[1]=o.getX(m+1),c[2]=o.getX(m+2)):(c[0]=m,c[1]=m+1,c[2]=m+2);let{a:y,b:p,c:g}=Fh;if(y.fromBufferAttribute(a,c[0]),p.fromBufferAttribute(a,c[1]),g.fromBufferAttribute(a,c[2]),Fh.getNormal(Pp),u[0]=`${Math.round(y.x*i)},${Math.round(y.y*i)},${Math.round(y.z*i)}`,u[1]=`${Math.round(p.x*i)},${Math.round(p.y*i)},${Math.round(p.z*i)}`,u[2]=`${Math.round(g.x*i)},${Math.round(g.y*i)},${Math.round(g.z*i)}`,!(u[0]===u[1]||u[1]===u[2]||u[2]===u[0]))for(let _=0;_<3;_++){let w=(_+1)%3,v=u[_],A=u[w],S=Fh[h[_]],x=Fh[h[w]],M=`${v}_${A}`,L=`${A}_${v}`,P=d.get(L);P?(Pp.dot(P.normal)<=r&&(f.push(S.x,S.y,S.z),f.push(x.x,x.y,x.z)),d.set(L,null)):d.has(M)||d.set(M,{index0:c[_],index1:c[w],normal:Pp.clone()})}}for(let m of d.values())if(m){let{index0:y,index1:p}=m;Dh.fromBufferAttribute(a,y),Oh.fromBufferAttribute(a,p),f.push(Dh.x,Dh.y,Dh.z),f.push(Oh.x,Oh.y,Oh.z)}this.setAttribute("position",new $t(f,3))}}copy(t){return super.copy(t),this.parameters=Object.assign({},t.parameters),this}};function NT(s,t,e=2){let n=t&&t.length,i=n?t[0]*e:s.length,r=Ex(s,0,i,e,!0),o=[];if(!r||r.next===r.prev)return o;let a,l,c;if(n&&(r=BT(s,t,r,e)),s.length>80*e){a=s[0],l=s[1];let h=a,u=l;for(let d=e;d<i;d+=e){let f=s[d],m=s[d+1];f<a&&(a=f),m<l&&(l=m),f>h&&(h=f),m>u&&(u=m)}c=Math.max(h-a,u-l),c=c!==0?32767/c:0}return Dl(r,o,e,a,l,c,0),o}function Ex(s,t,e,n,i){let r;if(i===$T(s,t,e,n)>0)for(let o=t;o<e;o+=n)r=A_(o/n|0,s[o],s[o+1],r);else for(let o=e-n;o>=t;o-=n)r=A_(o/n|0,s[o],s[o+1],r);return r&&_a(r,r.next)&&(Fl(r),r=r.next),r}function ao(s,t){if(!s)return s;t||(t=s);let e=s,n;do if(n=!1,!e.steiner&&(_a(e,e.next)||nn(e.prev,e,e.next)===0)){if(Fl(e),e=t=e.prev,e===e.next)break;n=!0}else e=e.next;while(n||e!==t);return t}function Dl(s,t,e,n,i,r,o){if(!s)return;!o&&r&&HT(s,n,i,r);let a=s;for(;s.prev!==s.next;){let l=s.prev,c=s.next;if(r?OT(s,n,i,r):DT(s)){t.push(l.i,s.i,c.i),Fl(s),s=c.next,a=c.next;continue}if(s=c,s===a){o?o===1?(s=FT(ao(s),t),Dl(s,t,e,n,i,r,2)):o===2&&UT(s,t,e,n,i,r):Dl(ao(s),t,e,n,i,r,1);break}}}function DT(s){let t=s.prev,e=s,n=s.next;if(nn(t,e,n)>=0)return!1;let i=t.x,r=e.x,o=n.x,a=t.y,l=e.y,c=n.y,h=Math.min(i,r,o),u=Math.min(a,l,c),d=Math.max(i,r,o),f=Math.max(a,l,c),m=n.next;for(;m!==t;){if(m.x>=h&&m.x<=d&&m.y>=u&&m.y<=f&&fl(i,a,r,l,o,c,m.x,m.y)&&nn(m.prev,m,m.next)>=0)return!1;m=m.next}return!0}function OT(s,t,e,n){let i=s.prev,r=s,o=s.next;if(nn(i,r,o)>=0)return!1;let a=i.x,l=r.x,c=o.x,h=i.y,u=r.y,d=o.y,f=Math.min(a,l,c),m=Math.min(h,u,d),y=Math.max(a,l,c),p=Math.max(h,u,d),g=Bp(f,m,t,e,n),_=Bp(y,p,t,e,n),w=s.prevZ,v=s.nextZ;for(;w&&w.z>=g&&v&&v.z<=_;){if(w.x>=f&&w.x<=y&&w.y>=m&&w.y<=p&&w!==i&&w!==o&&fl(a,h,l,u,c,d,w.x,w.y)&&nn(w.prev,w,w.next)>=0||(w=w.prevZ,v.x>=f&&v.x<=y&&v.y>=m&&v.y<=p&&v!==i&&v!==o&&fl(a,h,l,u,c,d,v.x,v.y)&&nn(v.prev,v,v.next)>=0))return!1;v=v.nextZ}for(;w&&w.z>=g;){if(w.x>=f&&w.x<=y&&w.y>=m&&w.y<=p&&w!==i&&w!==o&&fl(a,h,l,u,c,d,w.x,w.y)&&nn(w.prev,w,w.next)>=0)return!1;w=w.prevZ}for(;v&&v.z<=_;){if(v.x>=f&&v.x<=y&&v.y>=m&&v.y<=p&&v!==i&&v!==o&&fl(a,h,l,u,c,d,v.x,v.y)&&nn(v.prev,v,v.next)>=0)return!1;v=v.nextZ}return!0}function FT(s,t){let e=s;do{let n=e.prev,i=e.next.next;!_a(n,i)&&Rx(n,e,e.next,i)&&Ol(n,i)&&Ol(i,n)&&(t.push(n.i,e.i,i.i),Fl(e),Fl(e.next),e=s=i),e=e.next}while(e!==s);return ao(e)}function UT(s,t,e,n,i,r){let o=s;do{let a=o.next.next;for(;a!==o.prev;){if(o.i!==a.i&&qT(o,a)){let l=Px(o,a);o=ao(o,o.next),l=ao(l,l.next),Dl(o,t,e,n,i,r,0),Dl(l,t,e,n,i,r,0);return}a=a.next}o=o.next}while(o!==s)}function BT(s,t,e,n){let i=[];for(let r=0,o=t.length;r<o;r++){let a=t[r]*n,l=r<o-1?t[r+1]*n:s.length,c=Ex(s,a,l,n,!1);c===c.next&&(c.steiner=!0),i.push(XT(c))}i.sort(kT);for(let r=0;r<i.length;r++)e=zT(i[r],e);return e}function kT(s,t){let e=s.x-t.x;if(e===0&&(e=s.y-t.y,e===0)){let n=(s.next.y-s.y)/(s.next.x-s.x),i=(t.next.y-t.y)/(t.next.x-t.x);e=n-i}return e}function zT(s,t){let e=VT(s,t);if(!e)return t;let n=Px(e,s);return ao(n,n.next),ao(e,e.next)}function VT(s,t){let e=t,n=s.x,i=s.y,r=-1/0,o;if(_a(s,e))return e;do{if(_a(s,e.next))return e.next;if(i<=e.y&&i>=e.next.y&&e.next.y!==e.y){let u=e.x+(i-e.y)*(e.next.x-e.x)/(e.next.y-e.y);if(u<=n&&u>r&&(r=u,o=e.x<e.next.x?e:e.next,u===n))return o}e=e.next}while(e!==t);if(!o)return null;let a=o,l=o.x,c=o.y,h=1/0;e=o;do{if(n>=e.x&&e.x>=l&&n!==e.x&&Cx(i<c?n:r,i,l,c,i<c?r:n,i,e.x,e.y)){let u=Math.abs(i-e.y)/(n-e.x);Ol(e,s)&&(u<h||u===h&&(e.x>o.x||e.x===o.x&&GT(o,e)))&&(o=e,h=u)}e=e.next}while(e!==a);return o}function GT(s,t){return nn(s.prev,s,t.prev)<0&&nn(t.next,s,s.next)<0}function HT(s,t,e,n){let i=s;do i.z===0&&(i.z=Bp(i.x,i.y,t,e,n)),i.prevZ=i.prev,i.nextZ=i.next,i=i.next;while(i!==s);i.prevZ.nextZ=null,i.prevZ=null,WT(i)}function WT(s){let t,e=1;do{let n=s,i;s=null;let r=null;for(t=0;n;){t++;let o=n,a=0;for(let c=0;c<e&&(a++,o=o.nextZ,!!o);c++);let l=e;for(;a>0||l>0&&o;)a!==0&&(l===0||!o||n.z<=o.z)?(i=n,n=n.nextZ,a--):(i=o,o=o.nextZ,l--),r?r.nextZ=i:s=i,i.prevZ=r,r=i;n=o}r.nextZ=null,e*=2}while(t>1);return s}function Bp(s,t,e,n,i){return s=(s-e)*i|0,t=(t-n)*i|0,s=(s|s<<8)&16711935,s=(s|s<<4)&252645135,s=(s|s<<2)&858993459,s=(s|s<<1)&1431655765,t=(t|t<<8)&16711935,t=(t|t<<4)&252645135,t=(t|t<<2)&858993459,t=(t|t<<1)&1431655765,s|t<<1}function XT(s){let t=s,e=s;do(t.x<e.x||t.x===e.x&&t.y<e.y)&&(e=t),t=t.next;while(t!==s);return e}function Cx(s,t,e,n,i,r,o,a){return(i-o)*(t-a)>=(s-o)*(r-a)&&(s-o)*(n-a)>=(e-o)*(t-a)&&(e-o)*(r-a)>=(i-o)*(n-a)}function fl(s,t,e,n,i,r,o,a){return!(s===o&&t===a)&&Cx(s,t,e,n,i,r,o,a)}function qT(s,t){return s.next.i!==t.i&&s.prev.i!==t.i&&!jT(s,t)&&(Ol(s,t)&&Ol(t,s)&&YT(s,t)&&(nn(s.prev,s,t.prev)||nn(s,t.prev,t))||_a(s,t)&&nn(s.prev,s,s.next)>0&&nn(t.prev,t,t.next)>0)}function nn(s,t,e){return(t.y-s.y)*(e.x-t.x)-(t.x-s.x)*(e.y-t.y)}function _a(s,t){return s.x===t.x&&s.y===t.y}function Rx(s,t,e,n){let i=Bh(nn(s,t,e)),r=Bh(nn(s,t,n)),o=Bh(nn(e,n,s)),a=Bh(nn(e,n,t));return!!(i!==r&&o!==a||i===0&&Uh(s,e,t)||r===0&&Uh(s,n,t)||o===0&&Uh(e,s,n)||a===0&&Uh(e,t,n))}function Uh(s,t,e){return t.x<=Math.max(s.x,e.x)&&t.x>=Math.min(s.x,e.x)&&t.y<=Math.max(s.y,e.y)&&t.y>=Math.min(s.y,e.y)}function Bh(s){return s>0?1:s<0?-1:0}function jT(s,t){let e=s;do{if(e.i!==s.i&&e.next.i!==s.i&&e.i!==t.i&&e.next.i!==t.i&&Rx(e,e.next,s,t))return!0;e=e.next}while(e!==s);return!1}function Ol(s,t){return nn(s.prev,s,s.next)<0?nn(s,t,s.next)>=0&&nn(s,s.prev,t)>=0:nn(s,t,s.prev)<0||nn(s,s.next,t)<0}function YT(s,t){let e=s,n=!1,i=(s.x+t.x)/2,r=(s.y+t.y)/2;do e.y>r!=e.next.y>r&&e.next.y!==e.y&&i<(e.next.x-e.x)*(r-e.y)/(e.next.y-e.y)+e.x&&(n=!n),e=e.next;while(e!==s);return n}function Px(s,t){let e=kp(s.i,s.x,s.y),n=kp(t.i,t.x,t.y),i=s.next,r=t.prev;return s.next=t,t.prev=s,e.next=i,i.prev=e,n.next=e,e.prev=n,r.next=n,n.prev=r,n}function A_(s,t,e,n){let i=kp(s,t,e);return n?(i.next=n.next,i.prev=n,n.next.prev=i,n.next=i):(i.prev=i,i.next=i),i}function Fl(s){s.next.prev=s.prev,s.prev.next=s.next,s.prevZ&&(s.prevZ.nextZ=s.nextZ),s.nextZ&&(s.nextZ.prevZ=s.prevZ)}function kp(s,t,e){return{i:s,x:t,y:e,prev:null,next:null,z:0,prevZ:null,nextZ:null,steiner:!1}}function $T(s,t,e,n){let i=0;for(let r=t,o=e-n;r<e;r+=n)i+=(s[o]-s[r])*(s[r+1]+s[o+1]),o=r;return i}var zp=class{static triangulate(t,e,n=2){return NT(t,e,n)}},xa=class s{static area(t){let e=t.length,n=0;for(let i=e-1,r=0;r<e;i=r++)n+=t[i].x*t[r].y-t[r].x*t[i].y;return n*.5}static isClockWise(t){return s.area(t)<0}static triangulateShape(t,e){let n=[],i=[],r=[];E_(t),C_(n,t);let o=t.length;e.forEach(E_);for(let l=0;l<e.length;l++)i.push(o),o+=e[l].length,C_(n,e[l]);let a=zp.triangulate(n,i);for(let l=0;l<a.length;l+=3)r.push(a.slice(l,l+3));return r}};function E_(s){let t=s.length;t>2&&s[t-1].equals(s[0])&&s.pop()}function C_(s,t){for(let e=0;e<t.length;e++)s.push(t[e].x),s.push(t[e].y)}var hs=class s extends Ae{constructor(t=1,e=1,n=1,i=1){super(),this.type="PlaneGeometry",this.parameters={width:t,height:e,widthSegments:n,heightSegments:i};let r=t/2,o=e/2,a=Math.floor(n),l=Math.floor(i),c=a+1,h=l+1,u=t/a,d=e/l,f=[],m=[],y=[],p=[];for(let g=0;g<h;g++){let _=g*d-o;for(let w=0;w<c;w++){let v=w*u-r;m.push(v,-_,0),y.push(0,0,1),p.push(w/a),p.push(1-g/l)}}for(let g=0;g<l;g++)for(let _=0;_<a;_++){let w=_+c*g,v=_+c*(g+1),A=_+1+c*(g+1),S=_+1+c*g;f.push(w,v,S),f.push(v,A,S)}this.setIndex(f),this.setAttribute("position",new $t(m,3)),this.setAttribute("normal",new $t(y,3)),this.setAttribute("uv",new $t(p,2))}copy(t){return super.copy(t),this.parameters=Object.assign({},t.parameters),this}static fromJSON(t){return new s(t.width,t.height,t.widthSegments,t.heightSegments)}};var er=class s extends Ae{constructor(t=1,e=32,n=16,i=0,r=Math.PI*2,o=0,a=Math.PI){super(),this.type="SphereGeometry",this.parameters={radius:t,widthSegments:e,heightSegments:n,phiStart:i,phiLength:r,thetaStart:o,thetaLength:a},e=Math.max(3,Math.floor(e)),n=Math.max(2,Math.floor(n));let l=Math.min(o+a,Math.PI),c=0,h=[],u=new F,d=new F,f=[],m=[],y=[],p=[];for(let g=0;g<=n;g++){let _=[],w=g/n,v=o+w*a,A=t*Math.cos(v),S=Math.sqrt(t*t-A*A),x=0;g===0&&o===0?x=.5/e:g===n&&l===Math.PI&&(x=-.5/e);for(let M=0;M<=e;M++){let L=M/e,P=i+L*r;u.x=-S*Math.cos(P),u.y=A,u.z=S*Math.sin(P),m.push(u.x,u.y,u.z),d.copy(u).normalize(),y.push(d.x,d.y,d.z),p.push(L+x,1-w),_.push(c++)}h.push(_)}for(let g=0;g<n;g++)for(let _=0;_<e;_++){let w=h[g][_+1],v=h[g][_],A=h[g+1][_],S=h[g+1][_+1];(g!==0||o>0)&&f.push(w,v,S),(g!==n-1||l<Math.PI)&&f.push(v,A,S)}this.setIndex(f),this.setAttribute("position",new $t(m,3)),this.setAttribute("normal",new $t(y,3)),this.setAttribute("uv",new $t(p,2))}copy(t){return super.copy(t),this.parameters=Object.assign({},t.parameters),this}static fromJSON(t){return new s(t.radius,t.widthSegments,t.heightSegments,t.phiStart,t.phiLength,t.thetaStart,t.thetaLength)}};var Ul=class extends Ae{constructor(t=null){if(super(),this.type="WireframeGeometry",this.parameters={geometry:t},t!==null){let e=[],n=new Set,i=new F,r=new F;if(t.index!==null){let o=t.attributes.position,a=t.index,l=t.groups;l.length===0&&(l=[{start:0,count:a.count,materialIndex:0}]);for(let c=0,h=l.length;c<h;++c){let u=l[c],d=u.start,f=u.count;for(let m=d,y=d+f;m<y;m+=3)for(let p=0;p<3;p++){let g=a.getX(m+p),_=a.getX(m+(p+1)%3);i.fromBufferAttribute(o,g),r.fromBufferAttribute(o,_),R_(i,r,n)===!0&&(e.push(i.x,i.y,i.z),e.push(r.x,r.y,r.z))}}}else{let o=t.attributes.position;for(let a=0,l=o.count/3;a<l;a++)for(let c=0;c<3;c++){let h=3*a+c,u=3*a+(c+1)%3;i.fromBufferAttribute(o,h),r.fromBufferAttribute(o,u),R_(i,r,n)===!0&&(e.push(i.x,i.y,i.z),e.push(r.x,r.y,r.z))}}this.setAttribute("position",new $t(e,3))}}copy(t){return super.copy(t),this.parameters=Object.assign({},t.parameters),this}};function R_(s,t,e){let n=`${s.x},${s.y},${s.z}-${t.x},${t.y},${t.z}`,i=`${t.x},${t.y},${t.z}-${s.x},${s.y},${s.z}`;return e.has(n)===!0||e.has(i)===!0?!1:(e.add(n),e.add(i),!0)}var Bl=class extends gi{constructor(t){super(),this.isShadowMaterial=!0,this.type="ShadowMaterial",this.color=new Rt(0),this.transparent=!0,this.fog=!0,this.setValues(t)}copy(t){return super.copy(t),this.color.copy(t.color),this.fog=t.fog,this}};function vo(s){let t={};for(let e in s){t[e]={};for(let n in s[e]){let i=s[e][n];if(P_(i))i.isRenderTargetTexture?(Yt("UniformsUtils: Textures of render targets cannot be cloned via cloneUniforms() or mergeUniforms()."),t[e][n]=null):t[e][n]=i.clone();else if(Array.isArray(i))if(P_(i[0])){let r=[];for(let o=0,a=i.length;o<a;o++)r[o]=i[o].clone();t[e][n]=r}else t[e][n]=i.slice();else t[e][n]=i}}return t}function si(s){let t={};for(let e=0;e<s.length;e++){let n=vo(s[e]);for(let i in n)t[i]=n[i]}return t}function P_(s){return s&&(s.isColor||s.isMatrix3||s.isMatrix4||s.isVector2||s.isVector3||s.isVector4||s.isTexture||s.isQuaternion)}function JT(s){let t=[];for(let e=0;e<s.length;e++)t.push(s[e].clone());return t}function wm(s){let t=s.getRenderTarget();return t===null?s.outputColorSpace:t.isXRRenderTarget===!0?t.texture.colorSpace:ue.workingColorSpace}var sc={clone:vo,merge:si},KT=`void main() {
	gl_Position = projectionMatrix * modelViewMatrix * vec4( position, 1.0 );
}`,ZT=`void main() {
	gl_FragColor = vec4( 1.0, 0.0, 0.0, 1.0 );
}`,vi=class extends gi{constructor(t){super(),this.isShaderMaterial=!0,this.type="ShaderMaterial",this.defines={},this.uniforms={},this.uniformsGroups=[],this.vertexShader=KT,this.fragmentShader=ZT,this.linewidth=1,this.wireframe=!1,this.wireframeLinewidth=1,this.fog=!1,this.lights=!1,this.clipping=!1,this.forceSinglePass=!0,this.extensions={clipCullDistance:!1,multiDraw:!1},this.defaultAttributeValues={color:[1,1,1],uv:[0,0],uv1:[0,0]},this.index0AttributeName=void 0,this.uniformsNeedUpdate=!1,this.glslVersion=null,t!==void 0&&this.setValues(t)}copy(t){return super.copy(t),this.fragmentShader=t.fragmentShader,this.vertexShader=t.vertexShader,this.uniforms=vo(t.uniforms),this.uniformsGroups=JT(t.uniformsGroups),this.defines=Object.assign({},t.defines),this.wireframe=t.wireframe,this.wireframeLinewidth=t.wireframeLinewidth,this.fog=t.fog,this.lights=t.lights,this.clipping=t.clipping,this.extensions=Object.assign({},t.extensions),this.glslVersion=t.glslVersion,this.defaultAttributeValues=Object.assign({},t.defaultAttributeValues),this.index0AttributeName=t.index0AttributeName,this.uniformsNeedUpdate=t.uniformsNeedUpdate,this}toJSON(t){let e=super.toJSON(t);e.glslVersion=this.glslVersion,e.uniforms={};for(let i in this.uniforms){let o=this.uniforms[i].value;o&&o.isTexture?e.uniforms[i]={type:"t",value:o.toJSON(t).uuid}:o&&o.isColor?e.uniforms[i]={type:"c",value:o.getHex()}:o&&o.isVector2?e.uniforms[i]={type:"v2",value:o.toArray()}:o&&o.isVector3?e.uniforms[i]={type:"v3",value:o.toArray()}:o&&o.isVector4?e.uniforms[i]={type:"v4",value:o.toArray()}:o&&o.isMatrix3?e.uniforms[i]={type:"m3",value:o.toArray()}:o&&o.isMatrix4?e.uniforms[i]={type:"m4",value:o.toArray()}:e.uniforms[i]={value:o}}Object.keys(this.defines).length>0&&(e.defines=this.defines),e.vertexShader=this.vertexShader,e.fragmentShader=this.fragmentShader,e.lights=this.lights,e.clipping=this.clipping;let n={};for(let i in this.extensions)this.extensions[i]===!0&&(n[i]=!0);return Object.keys(n).length>0&&(e.extensions=n),e}fromJSON(t,e){if(super.fromJSON(t,e),t.uniforms!==void 0)for(let n in t.uniforms){let i=t.uniforms[n];switch(this.uniforms[n]={},i.type){case"t":this.uniforms[n].value=e[i.value]||null;break;case"c":this.uniforms[n].value=new Rt().setHex(i.value);break;case"v2":this.uniforms[n].value=new Xt().fromArray(i.value);break;case"v3":this.uniforms[n].value=new F().fromArray(i.value);break;case"v4":this.uniforms[n].value=new Se().fromArray(i.value);break;case"m3":this.uniforms[n].value=new se().fromArray(i.value);break;case"m4":this.uniforms[n].value=new Nt().fromArray(i.value);break;default:this.uniforms[n].value=i.value}}if(t.defines!==void 0&&(this.defines=t.defines),t.vertexShader!==void 0&&(this.vertexShader=t.vertexShader),t.fragmentShader!==void 0&&(this.fragmentShader=t.fragmentShader),t.glslVersion!==void 0&&(this.glslVersion=t.glslVersion),t.extensions!==void 0)for(let n in t.extensions)this.extensions[n]=t.extensions[n];return t.lights!==void 0&&(this.lights=t.lights),t.clipping!==void 0&&(this.clipping=t.clipping),this}},ou=class extends vi{constructor(t){super(t),this.isRawShaderMaterial=!0,this.type="RawShaderMaterial"}};var qn=class extends gi{constructor(t){super(),this.isMeshPhongMaterial=!0,this.type="MeshPhongMaterial",this.color=new Rt(16777215),this.specular=new Rt(1118481),this.shininess=30,this.map=null,this.lightMap=null,this.lightMapIntensity=1,this.aoMap=null,this.aoMapIntensity=1,this.emissive=new Rt(0),this.emissiveIntensity=1,this.emissiveMap=null,this.bumpMap=null,this.bumpScale=1,this.normalMap=null,this.normalMapType=ic,this.normalScale=new Xt(1,1),this.displacementMap=null,this.displacementScale=1,this.displacementBias=0,this.specularMap=null,this.alphaMap=null,this.envMap=null,this.envMapRotation=new xi,this.combine=$l,this.reflectivity=1,this.envMapIntensity=1,this.refractionRatio=.98,this.wireframe=!1,this.wireframeLinewidth=1,this.wireframeLinecap="round",this.wireframeLinejoin="round",this.flatShading=!1,this.fog=!0,this.setValues(t)}copy(t){return super.copy(t),this.color.copy(t.color),this.specular.copy(t.specular),this.shininess=t.shininess,this.map=t.map,this.lightMap=t.lightMap,this.lightMapIntensity=t.lightMapIntensity,this.aoMap=t.aoMap,this.aoMapIntensity=t.aoMapIntensity,this.emissive.copy(t.emissive),this.emissiveMap=t.emissiveMap,this.emissiveIntensity=t.emissiveIntensity,this.bumpMap=t.bumpMap,this.bumpScale=t.bumpScale,this.normalMap=t.normalMap,this.normalMapType=t.normalMapType,this.normalScale.copy(t.normalScale),this.displacementMap=t.displacementMap,this.displacementScale=t.displacementScale,this.displacementBias=t.displacementBias,this.specularMap=t.specularMap,this.alphaMap=t.alphaMap,this.envMap=t.envMap,this.envMapRotation.copy(t.envMapRotation),this.combine=t.combine,this.reflectivity=t.reflectivity,this.envMapIntensity=t.envMapIntensity,this.refractionRatio=t.refractionRatio,this.wireframe=t.wireframe,this.wireframeLinewidth=t.wireframeLinewidth,this.wireframeLinecap=t.wireframeLinecap,this.wireframeLinejoin=t.wireframeLinejoin,this.flatShading=t.flatShading,this.fog=t.fog,this}};var lo=class extends gi{constructor(t){super(),this.isMeshLambertMaterial=!0,this.type="MeshLambertMaterial",this.color=new Rt(16777215),this.map=null,this.lightMap=null,this.lightMapIntensity=1,this.aoMap=null,this.aoMapIntensity=1,this.emissive=new Rt(0),this.emissiveIntensity=1,this.emissiveMap=null,this.bumpMap=null,this.bumpScale=1,this.normalMap=null,this.normalMapType=ic,this.normalScale=new Xt(1,1),this.displacementMap=null,this.displacementScale=1,this.displacementBias=0,this.specularMap=null,this.alphaMap=null,this.envMap=null,this.envMapRotation=new xi,this.combine=$l,this.reflectivity=1,this.envMapIntensity=1,this.refractionRatio=.98,this.wireframe=!1,this.wireframeLinewidth=1,this.wireframeLinecap="round",this.wireframeLinejoin="round",this.flatShading=!1,this.fog=!0,this.setValues(t)}copy(t){return super.copy(t),this.color.copy(t.color),this.map=t.map,this.lightMap=t.lightMap,this.lightMapIntensity=t.lightMapIntensity,this.aoMap=t.aoMap,this.aoMapIntensity=t.aoMapIntensity,this.emissive.copy(t.emissive),this.emissiveMap=t.emissiveMap,this.emissiveIntensity=t.emissiveIntensity,this.bumpMap=t.bumpMap,this.bumpScale=t.bumpScale,this.normalMap=t.normalMap,this.normalMapType=t.normalMapType,this.normalScale.copy(t.normalScale),this.displacementMap=t.displacementMap,this.displacementScale=t.displacementScale,this.displacementBias=t.displacementBias,this.specularMap=t.specularMap,this.alphaMap=t.alphaMap,this.envMap=t.envMap,this.envMapRotation.copy(t.envMapRotation),this.combine=t.combine,this.reflectivity=t.reflectivity,this.envMapIntensity=t.envMapIntensity,this.refractionRatio=t.refractionRatio,this.wireframe=t.wireframe,this.wireframeLinewidth=t.wireframeLinewidth,this.wireframeLinecap=t.wireframeLinecap,this.wireframeLinejoin=t.wireframeLinejoin,this.flatShading=t.flatShading,this.fog=t.fog,this}},au=class extends gi{constructor(t){super(),this.isMeshDepthMaterial=!0,this.type="MeshDepthMaterial",this.depthPacking=px,this.map=null,this.alphaMap=null,this.displacementMap=null,this.displacementScale=1,this.displacementBias=0,this.wireframe=!1,this.wireframeLinewidth=1,this.setValues(t)}copy(t){return super.copy(t),this.depthPacking=t.depthPacking,this.map=t.map,this.alphaMap=t.alphaMap,this.displacementMap=t.displacementMap,this.displacementScale=t.displacementScale,this.displacementBias=t.displacementBias,this.wireframe=t.wireframe,this.wireframeLinewidth=t.wireframeLinewidth,this}},lu=class extends gi{constructor(t){super(),this.isMeshDistanceMaterial=!0,this.type="MeshDistanceMaterial",this.map=null,this.alphaMap=null,this.displacementMap=null,this.displacementScale=1,this.displacementBias=0,this.setValues(t)}copy(t){return super.copy(t),this.map=t.map,this.alphaMap=t.alphaMap,this.displacementMap=t.displacementMap,this.displacementScale=t.displacementScale,this.displacementBias=t.displacementBias,this}};function wr(s,t){return!s||s.constructor===t?s:typeof t.BYTES_PER_ELEMENT=="number"?new t(s):Array.prototype.slice.call(s)}function pl(s){return s!==void 0&&s.inTangents!==void 0&&s.outTangents!==void 0}function QT(s){function t(i,r){return s[i]-s[r]}let e=s.length,n=new Array(e);for(let i=0;i!==e;++i)n[i]=i;return n.sort(t),n}function L_(s,t,e){let n=s.length,i=new s.constructor(n);for(let r=0,o=0;o!==n;++r){let a=e[r]*t;for(let l=0;l!==t;++l)i[o++]=s[a+l]}return i}function tA(s,t,e,n){let i=1,r=s[0];for(;r!==void 0&&r[n]===void 0;)r=s[i++];if(r===void 0)return;let o=r[n];if(o!==void 0)if(Array.isArray(o))do o=r[n],o!==void 0&&(t.push(r.time),e.push(...o)),r=s[i++];while(r!==void 0);else if(o.toArray!==void 0)do o=r[n],o!==void 0&&(t.push(r.time),o.toArray(e,e.length)),r=s[i++];while(r!==void 0);else do o=r[n],o!==void 0&&(t.push(r.time),e.push(o)),r=s[i++];while(r!==void 0)}var Rr=class{constructor(t,e,n,i){this.parameterPositions=t,this._cachedIndex=0,this.resultBuffer=i!==void 0?i:new e.constructor(n),this.sampleValues=e,this.valueSize=n,this.settings=null,this.DefaultSettings_={}}evaluate(t){let e=this.parameterPositions,n=this._cachedIndex,i=e[n],r=e[n-1];n:{t:{let o;e:{i:if(!(t<i)){for(let a=n+2;;){if(i===void 0){if(t<r)break i;return n=e.length,this._cachedIndex=n,this.copySampleValue_(n-1)}if(n===a)break;if(r=i,i=e[++n],t<i)break t}o=e.length;break e}if(!(t>=r)){let a=e[1];t<a&&(n=2,r=a);for(let l=n-2;;){if(r===void 0)return this._cachedIndex=0,this.copySampleValue_(0);if(n===l)break;if(i=r,r=e[--n-1],t>=r)break t}o=n,n=0;break e}break n}for(;n<o;){let a=n+o>>>1;t<e[a]?o=a:n=a+1}if(i=e[n],r=e[n-1],r===void 0)return this._cachedIndex=0,this.copySampleValue_(0);if(i===void 0)return n=e.length,this._cachedIndex=n,this.copySampleValue_(n-1)}this._cachedIndex=n,this.intervalChanged_(n,r,i)}return this.interpolate_(n,r,t,i)}getSettings_(){return this.settings||this.DefaultSettings_}copySampleValue_(t){let e=this.resultBuffer,n=this.sampleValues,i=this.valueSize,r=t*i;for(let o=0;o!==i;++o)e[o]=n[r+o];return e}interpolate_(){throw new Error("THREE.Interpolant: Call to abstract method.")}intervalChanged_(){}},cu=class extends Rr{constructor(t,e,n,i){super(t,e,n,i),this._weightPrev=-0,this._offsetPrev=-0,this._weightNext=-0,this._offsetNext=-0,this.DefaultSettings_={endingStart:Dp,endingEnd:Dp}}intervalChanged_(t,e,n){let i=this.parameterPositions,r=t-2,o=t+1,a=i[r],l=i[o];if(a===void 0)switch(this.getSettings_().endingStart){case Op:r=t,a=2*e-n;break;case Fp:r=i.length-2,a=e+i[r]-i[r+1];break;default:r=t,a=n}if(l===void 0)switch(this.getSettings_().endingEnd){case Op:o=t,l=2*n-e;break;case Fp:o=1,l=n+i[1]-i[0];break;default:o=t-1,l=e}let c=(n-e)*.5,h=this.valueSize;this._weightPrev=c/(e-a),this._weightNext=c/(l-n),this._offsetPrev=r*h,this._offsetNext=o*h}interpolate_(t,e,n,i){let r=this.resultBuffer,o=this.sampleValues,a=this.valueSize,l=t*a,c=l-a,h=this._offsetPrev,u=this._offsetNext,d=this._weightPrev,f=this._weightNext,m=(n-e)/(i-e),y=m*m,p=y*m,g=-d*p+2*d*y-d*m,_=(1+d)*p+(-1.5-2*d)*y+(-.5+d)*m+1,w=(-1-f)*p+(1.5+f)*y+.5*m,v=f*p-f*y;for(let A=0;A!==a;++A)r[A]=g*o[h+A]+_*o[c+A]+w*o[l+A]+v*o[u+A];return r}},hu=class extends Rr{constructor(t,e,n,i){super(t,e,n,i)}interpolate_(t,e,n,i){let r=this.resultBuffer,o=this.sampleValues,a=this.valueSize,l=t*a,c=l-a,h=(n-e)/(i-e),u=1-h;for(let d=0;d!==a;++d)r[d]=o[c+d]*u+o[l+d]*h;return r}},uu=class extends Rr{constructor(t,e,n,i){super(t,e,n,i)}interpolate_(t){return this.copySampleValue_(t-1)}},du=class extends Rr{interpolate_(t,e,n,i){let r=this.resultBuffer,o=this.sampleValues,a=this.valueSize,l=t*a,c=l-a,h=this.inTangents,u=this.outTangents;if(!h||!u){let m=(n-e)/(i-e),y=1-m;for(let p=0;p!==a;++p)r[p]=o[c+p]*y+o[l+p]*m;return r}let d=a*2,f=t-1;for(let m=0;m!==a;++m){let y=o[c+m],p=o[l+m],g=f*d+m*2,_=u[g],w=u[g+1],v=t*d+m*2,A=h[v],S=h[v+1],x=nA(n,e,_,A,i);r[m]=Lx(x,y,w,S,p)}return r}};function Lx(s,t,e,n,i){let r=1-s;return r*r*r*t+3*r*r*s*e+3*r*s*s*n+s*s*s*i}function eA(s,t,e,n,i){let r=1-s;return 3*r*r*(e-t)+6*r*s*(n-e)+3*s*s*(i-n)}function nA(s,t,e,n,i){let r=(s-t)/(i-t);for(let o=0;o<8;o++){let a=Lx(r,t,e,n,i)-s;if(Math.abs(a)<1e-10)break;let l=eA(r,t,e,n,i);if(Math.abs(l)<1e-10)break;r=Math.max(0,Math.min(1,r-a/l))}return r}var bi=class{constructor(t,e,n,i){if(t===void 0)throw new Error("THREE.KeyframeTrack: track name is undefined");if(e===void 0||e.length===0)throw new Error("THREE.KeyframeTrack: no keyframes in track named "+t);this.name=t,this.times=wr(e,this.TimeBufferType),this.values=wr(n,this.ValueBufferType),this.setInterpolation(i||this.DefaultInterpolation)}static toJSON(t){let e=t.constructor,n;if(e.toJSON!==this.toJSON)n=e.toJSON(t);else{n={name:t.name,times:wr(t.times,Array),values:wr(t.values,Array)};let i=t.getInterpolation();i!==t.DefaultInterpolation&&(n.interpolation=i),pl(t.settings)&&(n.settings={inTangents:wr(t.settings.inTangents,Array),outTangents:wr(t.settings.outTangents,Array)})}return n.type=t.ValueTypeName,n}InterpolantFactoryMethodDiscrete(t){return new uu(this.times,this.values,this.getValueSize(),t)}InterpolantFactoryMethodLinear(t){return new hu(this.times,this.values,this.getValueSize(),t)}InterpolantFactoryMethodSmooth(t){return new cu(this.times,this.values,this.getValueSize(),t)}InterpolantFactoryMethodBezier(t){let e=new du(this.times,this.values,this.getValueSize(),t);return this.settings&&(e.inTangents=this.settings.inTangents,e.outTangents=this.settings.outTangents),e}setInterpolation(t){let e;switch(t){case so:e=this.InterpolantFactoryMethodDiscrete;break;case Zh:e=this.InterpolantFactoryMethodLinear;break;case Gh:e=this.InterpolantFactoryMethodSmooth;break;case yl:e=this.InterpolantFactoryMethodBezier;break}if(e===void 0){let n="unsupported interpolation for "+this.ValueTypeName+" keyframe track named "+this.name;if(this.createInterpolant===void 0)if(t!==this.DefaultInterpolation)this.setInterpolation(this.DefaultInterpolation);else throw new Error(n);return Yt("KeyframeTrack:",n),this}return this.createInterpolant=e,this}getInterpolation(){switch(this.createInterpolant){case this.InterpolantFactoryMethodDiscrete:return so;case this.InterpolantFactoryMethodLinear:return Zh;case this.InterpolantFactoryMethodSmooth:return Gh;case this.InterpolantFactoryMethodBezier:return yl}}getValueSize(){return this.values.length/this.times.length}shift(t){if(t!==0){let e=this.times;for(let n=0,i=e.length;n!==i;++n)e[n]+=t;pl(this.settings)&&(I_(this.settings.inTangents,t),I_(this.settings.outTangents,t))}return this}scale(t){if(t!==1){let e=this.times;for(let n=0,i=e.length;n!==i;++n)e[n]*=t;pl(this.settings)&&(N_(this.settings.inTangents,t),N_(this.settings.outTangents,t))}return this}trim(t,e){let n=this.times,i=n.length,r=0,o=i-1;for(;r!==i&&n[r]<t;)++r;for(;o!==-1&&n[o]>e;)--o;if(++o,r!==0||o!==i){r>=o&&(o=Math.max(o,1),r=o-1);let a=this.getValueSize();this.times=n.slice(r,o),this.values=this.values.slice(r*a,o*a)}return this}validate(){let t=!0,e=this.getValueSize();e-Math.floor(e)!==0&&(te("KeyframeTrack: Invalid value size in track.",this),t=!1);let n=this.times,i=this.values,r=n.length;r===0&&(te("KeyframeTrack: Track is empty.",this),t=!1);let o=null;for(let a=0;a!==r;a++){let l=n[a];if(typeof l=="number"&&isNaN(l)){te("KeyframeTrack: Time is not a valid number.",this,a,l),t=!1;break}if(o!==null&&o>l){te("KeyframeTrack: Out of order keys.",this,a,l,o),t=!1;break}o=l}if(i!==void 0&&Jw(i))for(let a=0,l=i.length;a!==l;++a){let c=i[a];if(isNaN(c)){te("KeyframeTrack: Value is not a valid number.",this,a,c),t=!1;break}}return t}optimize(){let t=this.times.slice(),e=this.values.slice(),n=this.getValueSize(),i=this.getInterpolation()===Gh,r=t.length-1,o=1;for(let a=1;a<r;++a){let l=!1,c=t[a],h=t[a+1];if(c!==h&&(a!==1||c!==t[0]))if(i)l=!0;else{let u=a*n,d=u-n,f=u+n;for(let m=0;m!==n;++m){let y=e[u+m];if(y!==e[d+m]||y!==e[f+m]){l=!0;break}}}if(l){if(a!==o){t[o]=t[a];let u=a*n,d=o*n;for(let f=0;f!==n;++f)e[d+f]=e[u+f]}++o}}if(r>0){t[o]=t[r];for(let a=r*n,l=o*n,c=0;c!==n;++c)e[l+c]=e[a+c];++o}return o!==t.length?(this.times=t.slice(0,o),this.values=e.slice(0,o*n)):(this.times=t,this.values=e),this}clone(){let t=this.times.slice(),e=this.values.slice(),n=this.constructor,i=new n(this.name,t,e);return i.createInterpolant=this.createInterpolant,pl(this.settings)&&(i.settings={inTangents:this.settings.inTangents.slice(),outTangents:this.settings.outTangents.slice()}),i}};function I_(s,t){for(let e=0,n=s.length;e!==n;e+=2)s[e]+=t}function N_(s,t){for(let e=0,n=s.length;e!==n;e+=2)s[e]*=t}bi.prototype.ValueTypeName="";bi.prototype.TimeBufferType=Float32Array;bi.prototype.ValueBufferType=Float32Array;bi.prototype.DefaultInterpolation=Zh;var nr=class extends bi{constructor(t,e,n){super(t,e,n)}};nr.prototype.ValueTypeName="bool";nr.prototype.ValueBufferType=Array;nr.prototype.DefaultInterpolation=so;nr.prototype.InterpolantFactoryMethodLinear=void 0;nr.prototype.InterpolantFactoryMethodSmooth=void 0;var kl=class extends bi{constructor(t,e,n,i){super(t,e,n,i)}};kl.prototype.ValueTypeName="color";var va=class extends bi{constructor(t,e,n,i){super(t,e,n,i)}};va.prototype.ValueTypeName="number";var fu=class extends Rr{constructor(t,e,n,i){super(t,e,n,i)}interpolate_(t,e,n,i){let r=this.resultBuffer,o=this.sampleValues,a=this.valueSize,l=(n-e)/(i-e),c=t*a;for(let h=c+a;c!==h;c+=4)We.slerpFlat(r,0,o,c-a,o,c,l);return r}},ws=class extends bi{constructor(t,e,n,i){super(t,e,n,i)}InterpolantFactoryMethodLinear(t){return new fu(this.times,this.values,this.getValueSize(),t)}};ws.prototype.ValueTypeName="quaternion";ws.prototype.InterpolantFactoryMethodSmooth=void 0;var ir=class extends bi{constructor(t,e,n){super(t,e,n)}};ir.prototype.ValueTypeName="string";ir.prototype.ValueBufferType=Array;ir.prototype.DefaultInterpolation=so;ir.prototype.InterpolantFactoryMethodLinear=void 0;ir.prototype.InterpolantFactoryMethodSmooth=void 0;var ei=class extends bi{constructor(t,e,n,i){super(t,e,n,i)}};ei.prototype.ValueTypeName="vector";var ba=class{constructor(t="",e=-1,n=[],i=fx){this.name=t,this.tracks=n,this.duration=e,this.blendMode=i,this.uuid=Rs(),this.userData={},this.duration<0&&this.resetDuration()}static parse(t){let e=[],n=t.tracks,i=1/(t.fps||1);for(let o=0,a=n.length;o!==a;++o)e.push(sA(n[o]).scale(i));let r=new this(t.name,t.duration,e,t.blendMode);return r.uuid=t.uuid,r.userData=JSON.parse(t.userData||"{}"),r}static toJSON(t){let e=[],n=t.tracks,i={name:t.name,duration:t.duration,tracks:e,uuid:t.uuid,blendMode:t.blendMode,userData:JSON.stringify(t.userData)};for(let r=0,o=n.length;r!==o;++r)e.push(bi.toJSON(n[r]));return i}static CreateFromMorphTargetSequence(t,e,n,i){let r=e.length,o=[];for(let a=0;a<r;a++){let l=[],c=[];l.push((a+r-1)%r,a,(a+1)%r),c.push(0,1,0);let h=QT(l);l=L_(l,1,h),c=L_(c,1,h),!i&&l[0]===0&&(l.push(r),c.push(c[0])),o.push(new va(".morphTargetInfluences["+e[a].name+"]",l,c).scale(1/n))}return new this(t,-1,o)}static findByName(t,e){let n=t;if(!Array.isArray(t)){let i=t;n=i.geometry&&i.geometry.animations||i.animations}for(let i=0;i<n.length;i++)if(n[i].name===e)return n[i];return null}static CreateClipsFromMorphTargetSequences(t,e,n){let i={},r=/^([\w-]*?)([\d]+)$/;for(let a=0,l=t.length;a<l;a++){let c=t[a],h=c.name.match(r);if(h&&h.length>1){let u=h[1],d=i[u];d||(i[u]=d=[]),d.push(c)}}let o=[];for(let a in i)o.push(this.CreateFromMorphTargetSequence(a,i[a],e,n));return o}resetDuration(){let t=this.tracks,e=0;for(let n=0,i=t.length;n!==i;++n){let r=this.tracks[n];e=Math.max(e,r.times[r.times.length-1])}return this.duration=e,this}trim(){for(let t=0;t<this.tracks.length;t++)this.tracks[t].trim(0,this.duration);return this}validate(){let t=!0;for(let e=0;e<this.tracks.length;e++)t=t&&this.tracks[e].validate();return t}optimize(){for(let t=0;t<this.tracks.length;t++)this.tracks[t].optimize();return this}clone(){let t=[];for(let n=0;n<this.tracks.length;n++)t.push(this.tracks[n].clone());let e=new this.constructor(this.name,this.duration,t,this.blendMode);return e.userData=JSON.parse(JSON.stringify(this.userData)),e}toJSON(){return this.constructor.toJSON(this)}};function iA(s){switch(s.toLowerCase()){case"scalar":case"double":case"float":case"number":case"integer":return va;case"vector":case"vector2":case"vector3":case"vector4":return ei;case"color":return kl;case"quaternion":return ws;case"bool":case"boolean":return nr;case"string":return ir}throw new Error("THREE.KeyframeTrack: Unsupported typeName: "+s)}function sA(s){if(s.type===void 0)throw new Error("THREE.KeyframeTrack: track type undefined, can not parse");let t=iA(s.type);if(s.times===void 0){let n=[],i=[];tA(s.keys,n,i,"value"),s.times=n,s.values=i}let e;return t.parse!==void 0?e=t.parse(s):e=new t(s.name,s.times,s.values,s.interpolation),pl(s.settings)&&(e.settings={inTangents:wr(s.settings.inTangents,Float32Array),outTangents:wr(s.settings.outTangents,Float32Array)}),e}var ca={enabled:!1,files:{},add:function(s,t){this.enabled!==!1&&(D_(s)||(this.files[s]=t))},get:function(s){if(this.enabled!==!1&&!D_(s))return this.files[s]},remove:function(s){delete this.files[s]},clear:function(){this.files={}}};function D_(s){try{let t=s.slice(s.indexOf(":")+1);return new URL(t).protocol==="blob:"}catch{return!1}}var Sa=class{constructor(t,e,n){let i=this,r=!1,o=0,a=0,l,c=[];this.onStart=void 0,this.onLoad=t,this.onProgress=e,this.onError=n,this._abortController=null,this.itemStart=function(h){a++,r===!1&&i.onStart!==void 0&&i.onStart(h,o,a),r=!0},this.itemEnd=function(h){o++,i.onProgress!==void 0&&i.onProgress(h,o,a),o===a&&(r=!1,i.onLoad!==void 0&&i.onLoad())},this.itemError=function(h){i.onError!==void 0&&i.onError(h)},this.resolveURL=function(h){return h=h.normalize("NFC"),l?l(h):h},this.setURLModifier=function(h){return l=h,this},this.addHandler=function(h,u){return c.push(h,u),this},this.removeHandler=function(h){let u=c.indexOf(h);return u!==-1&&c.splice(u,2),this},this.getHandler=function(h){for(let u=0,d=c.length;u<d;u+=2){let f=c[u],m=c[u+1];if(f.global&&(f.lastIndex=0),f.test(h))return m}return null},this.abort=function(){return this.abortController.abort(),this._abortController=null,this}}get abortController(){return this._abortController||(this._abortController=new AbortController),this._abortController}},id=new Sa,ni=class{constructor(t){this.manager=t!==void 0?t:id,this.crossOrigin="anonymous",this.withCredentials=!1,this.path="",this.resourcePath="",this.requestHeader={},this.priority="auto",this.cache="default",typeof __THREE_DEVTOOLS__<"u"&&__THREE_DEVTOOLS__.dispatchEvent(new CustomEvent("observe",{detail:this}))}load(){}loadAsync(t,e){let n=this;return new Promise(function(i,r){n.load(t,i,e,r)})}parse(){}setCrossOrigin(t){return this.crossOrigin=t,this}setWithCredentials(t){return this.withCredentials=t,this}setPath(t){return this.path=t,this}setResourcePath(t){return this.resourcePath=t,this}setRequestHeader(t){return this.requestHeader=t,this}setPriority(t){return this.priority=t,this}setCache(t){return this.cache=t,this}abort(){return this}};ni.DEFAULT_MATERIAL_NAME="__DEFAULT";var Ys={},Vp=class extends Error{constructor(t,e){super(t),this.response=e}},Ts=class extends ni{constructor(t){super(t),this.mimeType="",this.responseType="",this._abortController=new AbortController}load(t,e,n,i){t===void 0&&(t=""),this.path!==void 0&&(t=this.path+t),t=this.manager.resolveURL(t);let r=ca.get(`file:${t}`);if(r!==void 0){this.manager.itemStart(t),setTimeout(()=>{e&&e(r),this.manager.itemEnd(t)},0);return}if(Ys[t]!==void 0){Ys[t].push({onLoad:e,onProgress:n,onError:i});return}Ys[t]=[],Ys[t].push({onLoad:e,onProgress:n,onError:i});let o=new Request(t,{headers:new Headers(this.requestHeader),credentials:this.withCredentials?"include":"same-origin",priority:this.priority,cache:this.cache,signal:typeof AbortSignal.any=="function"?AbortSignal.any([this._abortController.signal,this.manager.abortController.signal]):this._abortController.signal}),a=this.mimeType,l=this.responseType;fetch(o).then(c=>{if(c.status===200||c.status===0){if(c.status===0&&Yt("FileLoader: HTTP Status 0 received."),typeof ReadableStream>"u"||c.body===void 0||c.body.getReader===void 0)return c;let h=Ys[t],u=c.body.getReader(),d=c.headers.get("X-File-Size")||c.headers.get("Content-Length"),f=d?parseInt(d):0,m=f!==0,y=0,p=new ReadableStream({start(g){_();function _(){u.read().then(({done:w,value:v})=>{if(w)g.close();else{y+=v.byteLength;let A=new ProgressEvent("progress",{lengthComputable:m,loaded:y,total:f});for(let S=0,x=h.length;S<x;S++){let M=h[S];M.onProgress&&M.onProgress(A)}g.enqueue(v),_()}},w=>{g.error(w)})}}});return new Response(p)}else throw new Vp(`fetch for "${c.url}" responded with ${c.status}: ${c.statusText}`,c)}).then(c=>{switch(l){case"arraybuffer":return c.arrayBuffer();case"blob":return c.blob();case"document":return c.text().then(h=>new DOMParser().parseFromString(h,a));case"json":return c.json();default:if(a==="")return c.text();{let u=/charset="?([^;"\s]*)"?/i.exec(a),d=u&&u[1]?u[1].toLowerCase():void 0,f=new TextDecoder(d);return c.arrayBuffer().then(m=>f.decode(m))}}}).then(c=>{ca.add(`file:${t}`,c);let h=Ys[t];delete Ys[t];for(let u=0,d=h.length;u<d;u++){let f=h[u];f.onLoad&&f.onLoad(c)}}).catch(c=>{let h=Ys[t];if(h===void 0)throw this.manager.itemError(t),c;delete Ys[t];for(let u=0,d=h.length;u<d;u++){let f=h[u];f.onError&&f.onError(c)}this.manager.itemError(t)}).finally(()=>{this.manager.itemEnd(t)}),this.manager.itemStart(t)}setResponseType(t){return this.responseType=t,this}setMimeType(t){return this.mimeType=t,this}abort(){return this._abortController.abort(),this._abortController=new AbortController,this}};var na=new WeakMap,pu=class extends ni{constructor(t){super(t)}load(t,e,n,i){this.path!==void 0&&(t=this.path+t),t=this.manager.resolveURL(t);let r=this,o=ca.get(`image:${t}`);if(o!==void 0){if(o.complete===!0)r.manager.itemStart(t),setTimeout(function(){e&&e(o),r.manager.itemEnd(t)},0);else{let u=na.get(o);u===void 0&&(u=[],na.set(o,u)),u.push({onLoad:e,onError:i})}return o}let a=da("img");function l(){h(),e&&e(this);let u=na.get(this)||[];for(let d=0;d<u.length;d++){let f=u[d];f.onLoad&&f.onLoad(this)}na.delete(this),r.manager.itemEnd(t)}function c(u){h(),i&&i(u),ca.remove(`image:${t}`);let d=na.get(this)||[];for(let f=0;f<d.length;f++){let m=d[f];m.onError&&m.onError(u)}na.delete(this),r.manager.itemError(t),r.manager.itemEnd(t)}function h(){a.removeEventListener("load",l,!1),a.removeEventListener("error",c,!1)}return a.addEventListener("load",l,!1),a.addEventListener("error",c,!1),t.slice(0,5)!=="data:"&&this.crossOrigin!==void 0&&(a.crossOrigin=this.crossOrigin),ca.add(`image:${t}`,a),r.manager.itemStart(t),a.fetchPriority=this.priority,a.src=t,a}};var zl=class extends ni{constructor(t){super(t)}load(t,e,n,i){let r=this,o=new Ar,a=new Ts(this.manager);return a.setPriority(this.priority),a.setCache(this.cache),a.setResponseType("arraybuffer"),a.setRequestHeader(this.requestHeader),a.setPath(this.path),a.setWithCredentials(r.withCredentials),a.load(t,function(l){let c;try{c=r.parse(l)}catch(h){i!==void 0?i(h):te(h);return}r._applyTexData(o,c),e&&e(o,c)},n,i),o}createDataTexture(t){let e=new Ar;return this._applyTexData(e,this.parse(t)),e}_applyTexData(t,e){e.image!==void 0?t.image=e.image:e.data!==void 0&&(t.image.width=e.width,t.image.height=e.height,t.image.data=e.data),t.wrapS=e.wrapS!==void 0?e.wrapS:pi,t.wrapT=e.wrapT!==void 0?e.wrapT:pi,t.magFilter=e.magFilter!==void 0?e.magFilter:Bn,t.minFilter=e.minFilter!==void 0?e.minFilter:Bn,t.anisotropy=e.anisotropy!==void 0?e.anisotropy:1,e.colorSpace!==void 0&&(t.colorSpace=e.colorSpace),e.flipY!==void 0&&(t.flipY=e.flipY),e.format!==void 0&&(t.format=e.format),e.type!==void 0&&(t.type=e.type),e.mipmaps!==void 0&&(t.mipmaps=e.mipmaps,t.minFilter=$i),e.mipmapCount===1&&(t.minFilter=Bn),e.generateMipmaps!==void 0&&(t.generateMipmaps=e.generateMipmaps),t.needsUpdate=!0}},co=class extends ni{constructor(t){super(t)}load(t,e,n,i){let r=new mi,o=new pu(this.manager);return o.setPriority(this.priority),o.setCache(this.cache),o.setCrossOrigin(this.crossOrigin),o.setPath(this.path),o.load(t,function(a){r.image=a,r.needsUpdate=!0,e!==void 0&&e(r)},n,i),r}},As=class extends sn{static registerNode(t){this.prototype._lightNode=t}constructor(t,e=1){super(),this.isLight=!0,this.type="Light",this.color=new Rt(t),this.intensity=e}copy(t,e){return super.copy(t,e),this.color.copy(t.color),this.intensity=t.intensity,this}toJSON(t){let e=super.toJSON(t);return e.object.color=this.color.getHex(),e.object.intensity=this.intensity,e}},Vl=class extends As{constructor(t,e,n){super(t,n),this.isHemisphereLight=!0,this.type="HemisphereLight",this.position.copy(sn.DEFAULT_UP),this.updateMatrix(),this.groundColor=new Rt(e)}copy(t,e){return super.copy(t,e),this.groundColor.copy(t.groundColor),this}toJSON(t){let e=super.toJSON(t);return e.object.groundColor=this.groundColor.getHex(),e}},Lp=new Nt,O_=new F,F_=new F,Ma=class{constructor(t){this.camera=t,this.intensity=1,this.bias=0,this.biasNode=null,this.normalBias=0,this.radius=1,this.blurSamples=8,this.mapSize=new Xt(512,512),this.mapType=Si,this.map=null,this.mapPass=null,this.matrix=new Nt,this.autoUpdate=!0,this.needsUpdate=!1,this._frustum=new Er,this._frameExtents=new Xt(1,1),this._viewportCount=1,this._viewports=[new Se(0,0,1,1)]}getViewportCount(){return this._viewportCount}getCamera(){return this.camera}getFrustum(){return this._frustum}updateMatrices(t){let e=this.camera;O_.setFromMatrixPosition(t.matrixWorld),e.position.copy(O_),F_.setFromMatrixPosition(t.target.matrixWorld),e.lookAt(F_),e.updateMatrixWorld(),this._updateMatrix(e,this.matrix,this._frustum)}_updateMatrix(t,e,n,i){Lp.multiplyMatrices(t.projectionMatrix,t.matrixWorldInverse),n.setFromProjectionMatrix(Lp,t.coordinateSystem,t.reversedDepth);let r=this._frameExtents,o=i?i.z/r.x:1,a=i?i.w/r.y:1,l=i?i.x/r.x:0,c=i?i.y/r.y:0;t.coordinateSystem===ua||t.reversedDepth?e.set(.5*o,0,0,.5*o+l,0,.5*a,0,.5*a+c,0,0,1,0,0,0,0,1):e.set(.5*o,0,0,.5*o+l,0,.5*a,0,.5*a+c,0,0,.5,.5,0,0,0,1),e.multiply(Lp)}getViewport(t){return this._viewports[t]}getFrameExtents(){return this._frameExtents}dispose(){this.map&&this.map.dispose(),this.mapPass&&this.mapPass.dispose()}copy(t){return this.camera=t.camera.clone(),this.intensity=t.intensity,this.bias=t.bias,this.radius=t.radius,this.autoUpdate=t.autoUpdate,this.needsUpdate=t.needsUpdate,this.normalBias=t.normalBias,this.blurSamples=t.blurSamples,this.mapSize.copy(t.mapSize),this.mapType=t.mapType,this.biasNode=t.biasNode,this}clone(){return new this.constructor().copy(this)}toJSON(){let t={};return t.intensity=this.intensity,t.bias=this.bias,t.normalBias=this.normalBias,t.radius=this.radius,t.blurSamples=this.blurSamples,t.mapSize=this.mapSize.toArray(),t.mapType=this.mapType,t.camera=this.camera.toJSON(!1).object,delete t.camera.matrix,t}},kh=new F,zh=new We,bs=new F,ho=class extends sn{constructor(){super(),this.isCamera=!0,this.type="Camera",this.matrixWorldInverse=new Nt,this.projectionMatrix=new Nt,this.projectionMatrixInverse=new Nt,this.coordinateSystem=ji,this._reversedDepth=!1}get reversedDepth(){return this._reversedDepth}copy(t,e){return super.copy(t,e),this.matrixWorldInverse.copy(t.matrixWorldInverse),this.projectionMatrix.copy(t.projectionMatrix),this.projectionMatrixInverse.copy(t.projectionMatrixInverse),this.coordinateSystem=t.coordinateSystem,this}getWorldDirection(t){return super.getWorldDirection(t).negate()}updateMatrixWorld(t){super.updateMatrixWorld(t),this.matrixWorld.decompose(kh,zh,bs),bs.x===1&&bs.y===1&&bs.z===1?this.matrixWorldInverse.copy(this.matrixWorld).invert():this.matrixWorldInverse.compose(kh,zh,bs.set(1,1,1)).invert()}updateWorldMatrix(t,e,n=!1){super.updateWorldMatrix(t,e,n),this.matrixWorld.decompose(kh,zh,bs),bs.x===1&&bs.y===1&&bs.z===1?this.matrixWorldInverse.copy(this.matrixWorld).invert():this.matrixWorldInverse.compose(kh,zh,bs.set(1,1,1)).invert()}clone(){return new this.constructor().copy(this)}},Mr=new F,U_=new Xt,B_=new Xt,Sn=class extends ho{constructor(t=50,e=1,n=.1,i=2e3){super(),this.isPerspectiveCamera=!0,this.type="PerspectiveCamera",this.fov=t,this.zoom=1,this.near=n,this.far=i,this.focus=10,this.aspect=e,this.view=null,this.filmGauge=35,this.filmOffset=0,this.updateProjectionMatrix()}copy(t,e){return super.copy(t,e),this.fov=t.fov,this.zoom=t.zoom,this.near=t.near,this.far=t.far,this.focus=t.focus,this.aspect=t.aspect,this.view=t.view===null?null:Object.assign({},t.view),this.filmGauge=t.filmGauge,this.filmOffset=t.filmOffset,this}setFocalLength(t){let e=.5*this.getFilmHeight()/t;this.fov=ro*2*Math.atan(e),this.updateProjectionMatrix()}getFocalLength(){let t=Math.tan(aa*.5*this.fov);return .5*this.getFilmHeight()/t}getEffectiveFOV(){return ro*2*Math.atan(Math.tan(aa*.5*this.fov)/this.zoom)}getFilmWidth(){return this.filmGauge*Math.min(this.aspect,1)}getFilmHeight(){return this.filmGauge/Math.max(this.aspect,1)}getViewBounds(t,e,n){Mr.set(-1,-1,.5).applyMatrix4(this.projectionMatrixInverse),e.set(Mr.x,Mr.y).multiplyScalar(-t/Mr.z),Mr.set(1,1,.5).applyMatrix4(this.projectionMatrixInverse),n.set(Mr.x,Mr.y).multiplyScalar(-t/Mr.z)}getViewSize(t,e){return this.getViewBounds(t,U_,B_),e.subVectors(B_,U_)}setViewOffset(t,e,n,i,r,o){this.aspect=t/e,this.view===null&&(this.view={enabled:!0,fullWidth:1,fullHeight:1,offsetX:0,offsetY:0,width:1,height:1}),this.view.enabled=!0,this.view.fullWidth=t,this.view.fullHeight=e,this.view.offsetX=n,this.view.offsetY=i,this.view.width=r,this.view.height=o,this.updateProjectionMatrix()}clearViewOffset(){this.view!==null&&(this.view.enabled=!1),this.updateProjectionMatrix()}updateProjectionMatrix(){let t=this.near,e=t*Math.tan(aa*.5*this.fov)/this.zoom,n=2*e,i=this.aspect*n,r=-.5*i,o=this.view;if(this.view!==null&&this.view.enabled){let l=o.fullWidth,c=o.fullHeight;r+=o.offsetX*i/l,e-=o.offsetY*n/c,i*=o.width/l,n*=o.height/c}let a=this.filmOffset;a!==0&&(r+=t*a/this.getFilmWidth()),this.projectionMatrix.makePerspective(r,r+i,e,e-n,t,this.far,this.coordinateSystem,this.reversedDepth),this.projectionMatrixInverse.copy(this.projectionMatrix).invert()}toJSON(t){let e=super.toJSON(t);return e.object.fov=this.fov,e.object.zoom=this.zoom,e.object.near=this.near,e.object.far=this.far,e.object.focus=this.focus,e.object.aspect=this.aspect,this.view!==null&&(e.object.view=Object.assign({},this.view)),e.object.filmGauge=this.filmGauge,e.object.filmOffset=this.filmOffset,e}},Gp=class extends Ma{constructor(){super(new Sn(50,1,.5,500)),this.isSpotLightShadow=!0,this.focus=1,this.aspect=1}updateMatrices(t){let e=this.camera,n=ro*2*t.angle*this.focus,i=this.mapSize.width/this.mapSize.height*this.aspect,r=t.distance||e.far;(n!==e.fov||i!==e.aspect||r!==e.far)&&(e.fov=n,e.aspect=i,e.far=r,e.updateProjectionMatrix()),super.updateMatrices(t)}copy(t){return super.copy(t),this.focus=t.focus,this.aspect=t.aspect,this}toJSON(){let t=super.toJSON();return t.focus=this.focus,t.aspect=this.aspect,t}},Gl=class extends As{constructor(t,e,n=0,i=Math.PI/3,r=0,o=2){super(t,e),this.isSpotLight=!0,this.type="SpotLight",this.position.copy(sn.DEFAULT_UP),this.updateMatrix(),this.target=new sn,this.distance=n,this.angle=i,this.penumbra=r,this.decay=o,this.map=null,this.shadow=new Gp}get power(){return this.intensity*Math.PI}set power(t){this.intensity=t/Math.PI}dispose(){super.dispose(),this.shadow.dispose()}copy(t,e){return super.copy(t,e),this.distance=t.distance,this.angle=t.angle,this.penumbra=t.penumbra,this.decay=t.decay,this.target=t.target.clone(),this.map=t.map,this.shadow=t.shadow.clone(),this}toJSON(t){let e=super.toJSON(t);return e.object.distance=this.distance,e.object.angle=this.angle,e.object.decay=this.decay,e.object.penumbra=this.penumbra,e.object.target=this.target.uuid,this.map&&this.map.isTexture&&(e.object.map=this.map.toJSON(t).uuid),e.object.shadow=this.shadow.toJSON(),e}},Hp=class extends Ma{constructor(){super(new Sn(90,1,.5,500)),this.isPointLightShadow=!0}},Hl=class extends As{constructor(t,e,n=0,i=2){super(t,e),this.isPointLight=!0,this.type="PointLight",this.distance=n,this.decay=i,this.shadow=new Hp}get power(){return this.intensity*4*Math.PI}set power(t){this.intensity=t/(4*Math.PI)}dispose(){super.dispose(),this.shadow.dispose()}copy(t,e){return super.copy(t,e),this.distance=t.distance,this.decay=t.decay,this.shadow=t.shadow.clone(),this}toJSON(t){let e=super.toJSON(t);return e.object.distance=this.distance,e.object.decay=this.decay,e.object.shadow=this.shadow.toJSON(),e}},uo=class extends ho{constructor(t=-1,e=1,n=1,i=-1,r=.1,o=2e3){super(),this.isOrthographicCamera=!0,this.type="OrthographicCamera",this.zoom=1,this.view=null,this.left=t,this.right=e,this.top=n,this.bottom=i,this.near=r,this.far=o,this.updateProjectionMatrix()}copy(t,e){return super.copy(t,e),this.left=t.left,this.right=t.right,this.top=t.top,this.bottom=t.bottom,this.near=t.near,this.far=t.far,this.zoom=t.zoom,this.view=t.view===null?null:Object.assign({},t.view),this}setViewOffset(t,e,n,i,r,o){this.view===null&&(this.view={enabled:!0,fullWidth:1,fullHeight:1,offsetX:0,offsetY:0,width:1,height:1}),this.view.enabled=!0,this.view.fullWidth=t,this.view.fullHeight=e,this.view.offsetX=n,this.view.offsetY=i,this.view.width=r,this.view.height=o,this.updateProjectionMatrix()}clearViewOffset(){this.view!==null&&(this.view.enabled=!1),this.updateProjectionMatrix()}updateProjectionMatrix(){let t=(this.right-this.left)/(2*this.zoom),e=(this.top-this.bottom)/(2*this.zoom),n=(this.right+this.left)/2,i=(this.top+this.bottom)/2,r=n-t,o=n+t,a=i+e,l=i-e;if(this.view!==null&&this.view.enabled){let c=(this.right-this.left)/this.view.fullWidth/this.zoom,h=(this.top-this.bottom)/this.view.fullHeight/this.zoom;r+=c*this.view.offsetX,o=r+c*this.view.width,a-=h*this.view.offsetY,l=a-h*this.view.height}this.projectionMatrix.makeOrthographic(r,o,a,l,this.near,this.far,this.coordinateSystem,this.reversedDepth),this.projectionMatrixInverse.copy(this.projectionMatrix).invert()}toJSON(t){let e=super.toJSON(t);return e.object.zoom=this.zoom,e.object.left=this.left,e.object.right=this.right,e.object.top=this.top,e.object.bottom=this.bottom,e.object.near=this.near,e.object.far=this.far,this.view!==null&&(e.object.view=Object.assign({},this.view)),e}},Wp=class extends Ma{constructor(){super(new uo(-5,5,5,-5,.5,500)),this.isDirectionalLightShadow=!0}},fo=class extends As{constructor(t,e){super(t,e),this.isDirectionalLight=!0,this.type="DirectionalLight",this.position.copy(sn.DEFAULT_UP),this.updateMatrix(),this.target=new sn,this.shadow=new Wp}dispose(){super.dispose(),this.shadow.dispose()}copy(t){return super.copy(t),this.target=t.target.clone(),this.shadow=t.shadow.clone(),this}toJSON(t){let e=super.toJSON(t);return e.object.shadow=this.shadow.toJSON(),e.object.target=this.target.uuid,e}},Wl=class extends As{constructor(t,e){super(t,e),this.isAmbientLight=!0,this.type="AmbientLight"}};var po=class{static extractUrlBase(t){let e=t.lastIndexOf("/");return e===-1?"./":t.slice(0,e+1)}static resolveURL(t,e){return typeof t!="string"||t===""?"":(/^https?:\/\//i.test(e)&&/^\//.test(t)&&(e=e.replace(/(^https?:\/\/[^\/]+).*/i,"$1")),/^(https?:)?\/\//i.test(t)||/^data:.*,.*$/i.test(t)||/^blob:.*$/i.test(t)?t:e+t)}},Xl=class extends Ae{constructor(){super(),this.isInstancedBufferGeometry=!0,this.type="InstancedBufferGeometry",this.instanceCount=1/0}copy(t){return super.copy(t),this.instanceCount=t.instanceCount,this}toJSON(){let t=super.toJSON();return t.instanceCount=this.instanceCount,t.isInstancedBufferGeometry=!0,t}};var ia=-90,sa=1,wa=class extends sn{constructor(t,e,n){super(),this.type="CubeCamera",this.renderTarget=n,this.coordinateSystem=null,this.activeMipmapLevel=0;let i=new Sn(ia,sa,t,e);i.layers=this.layers,this.add(i);let r=new Sn(ia,sa,t,e);r.layers=this.layers,this.add(r);let o=new Sn(ia,sa,t,e);o.layers=this.layers,this.add(o);let a=new Sn(ia,sa,t,e);a.layers=this.layers,this.add(a);let l=new Sn(ia,sa,t,e);l.layers=this.layers,this.add(l);let c=new Sn(ia,sa,t,e);c.layers=this.layers,this.add(c)}updateCoordinateSystem(){let t=this.coordinateSystem,e=this.children.concat(),[n,i,r,o,a,l]=e;for(let c of e)this.remove(c);if(t===ji)n.up.set(0,1,0),n.lookAt(1,0,0),i.up.set(0,1,0),i.lookAt(-1,0,0),r.up.set(0,0,-1),r.lookAt(0,1,0),o.up.set(0,0,1),o.lookAt(0,-1,0),a.up.set(0,1,0),a.lookAt(0,0,1),l.up.set(0,1,0),l.lookAt(0,0,-1);else if(t===ua)n.up.set(0,-1,0),n.lookAt(-1,0,0),i.up.set(0,-1,0),i.lookAt(1,0,0),r.up.set(0,0,1),r.lookAt(0,1,0),o.up.set(0,0,-1),o.lookAt(0,-1,0),a.up.set(0,-1,0),a.lookAt(0,0,1),l.up.set(0,-1,0),l.lookAt(0,0,-1);else throw new Error("THREE.CubeCamera.updateCoordinateSystem(): Invalid coordinate system: "+t);for(let c of e)this.add(c),c.updateMatrixWorld()}update(t,e){this.parent===null&&this.updateMatrixWorld();let{renderTarget:n,activeMipmapLevel:i}=this;this.coordinateSystem!==t.coordinateSystem&&(this.coordinateSystem=t.coordinateSystem,this.updateCoordinateSystem());let[r,o,a,l,c,h]=this.children,u=t.getRenderTarget(),d=t.getActiveCubeFace(),f=t.getActiveMipmapLevel(),m=t.xr.enabled;t.xr.enabled=!1;let y=n.texture.mipmapsAutoUpdate;n.texture.mipmapsAutoUpdate=!1;let p=!1;t.isWebGLRenderer===!0?p=t.state.buffers.depth.getReversed():p=t.reversedDepthBuffer,t.setRenderTarget(n,0,i),p&&t.autoClear===!1&&t.clearDepth(),t.render(e,r),t.setRenderTarget(n,1,i),p&&t.autoClear===!1&&t.clearDepth(),t.render(e,o),t.setRenderTarget(n,2,i),p&&t.autoClear===!1&&t.clearDepth(),t.render(e,a),t.setRenderTarget(n,3,i),p&&t.autoClear===!1&&t.clearDepth(),t.render(e,l),t.setRenderTarget(n,4,i),p&&t.autoClear===!1&&t.clearDepth(),t.render(e,c),n.texture.mipmapsAutoUpdate=y,t.setRenderTarget(n,5,i),p&&t.autoClear===!1&&t.clearDepth(),t.render(e,h),t.setRenderTarget(u,d,f),t.xr.enabled=m,n.texture.needsPMREMUpdate=!0}},mu=class extends Sn{constructor(t=[]){super(),this.isArrayCamera=!0,this.isMultiViewCamera=!1,this.cameras=t,this.perCameraFrustumCulled=!1}};var Tm="\\[\\]\\.:\\/",rA=new RegExp("["+Tm+"]","g"),Am="[^"+Tm+"]",oA="[^"+Tm.replace("\\.","")+"]",aA=/((?:WC+[\/:])*)/.source.replace("WC",Am),lA=/(WCOD+)?/.source.replace("WCOD",oA),cA=/(?:\.(WC+)(?:\[(.+)\])?)?/.source.replace("WC",Am),hA=/\.(WC+)(?:\[(.+)\])?/.source.replace("WC",Am),uA=new RegExp("^"+aA+lA+cA+hA+"$"),dA=["material","materials","bones","map"],Xp=class{constructor(t,e,n){let i=n||Ke.parseTrackName(e);this._targetGroup=t,this._bindings=t.subscribe_(e,i)}getValue(t,e){this.bind();let n=this._targetGroup.nCachedObjects_,i=this._bindings[n];i!==void 0&&i.getValue(t,e)}setValue(t,e){let n=this._bindings;for(let i=this._targetGroup.nCachedObjects_,r=n.length;i!==r;++i)n[i].setValue(t,e)}bind(){let t=this._bindings;for(let e=this._targetGroup.nCachedObjects_,n=t.length;e!==n;++e)t[e].bind()}unbind(){let t=this._bindings;for(let e=this._targetGroup.nCachedObjects_,n=t.length;e!==n;++e)t[e].unbind()}},Ke=class s{constructor(t,e,n){this.path=e,this.parsedPath=n||s.parseTrackName(e),this.node=s.findNode(t,this.parsedPath.nodeName),this.rootNode=t,this.getValue=this._getValue_unbound,this.setValue=this._setValue_unbound}static create(t,e,n){return t&&t.isAnimationObjectGroup?new s.Composite(t,e,n):new s(t,e,n)}static sanitizeNodeName(t){return t.replace(/\s/g,"_").replace(rA,"")}static parseTrackName(t){let e=uA.exec(t);if(e===null)throw new Error("THREE.PropertyBinding: Cannot parse trackName: "+t);let n={nodeName:e[2],objectName:e[3],objectIndex:e[4],propertyName:e[5],propertyIndex:e[6]},i=n.nodeName&&n.nodeName.lastIndexOf(".");if(i!==void 0&&i!==-1){let r=n.nodeName.substring(i+1);dA.indexOf(r)!==-1&&(n.nodeName=n.nodeName.substring(0,i),n.objectName=r)}if(n.propertyName===null||n.propertyName.length===0)throw new Error("THREE.PropertyBinding: can not parse propertyName from trackName: "+t);return n}static findNode(t,e){if(e===void 0||e===""||e==="."||e===-1||e===t.name||e===t.uuid)return t;if(t.skeleton){let n=t.skeleton.getBoneByName(e);if(n!==void 0)return n}if(t.children){let n=function(r){for(let o=0;o<r.length;o++){let a=r[o];if(a.name===e||a.uuid===e)return a;let l=n(a.children);if(l)return l}return null},i=n(t.children);if(i)return i}return null}_getValue_unavailable(){}_setValue_unavailable(){}_getValue_direct(t,e){t[e]=this.targetObject[this.propertyName]}_getValue_array(t,e){let n=this.resolvedProperty;for(let i=0,r=n.length;i!==r;++i)t[e++]=n[i]}_getValue_arrayElement(t,e){t[e]=this.resolvedProperty[this.propertyIndex]}_getValue_toArray(t,e){this.resolvedProperty.toArray(t,e)}_setValue_direct(t,e){this.targetObject[this.propertyName]=t[e]}_setValue_direct_setNeedsUpdate(t,e){this.targetObject[this.propertyName]=t[e],this.targetObject.needsUpdate=!0}_setValue_direct_setMatrixWorldNeedsUpdate(t,e){this.targetObject[this.propertyName]=t[e],this.targetObject.matrixWorldNeedsUpdate=!0}_setValue_array(t,e){let n=this.resolvedProperty;for(let i=0,r=n.length;i!==r;++i)n[i]=t[e++]}_setValue_array_setNeedsUpdate(t,e){let n=this.resolvedProperty;for(let i=0,r=n.length;i!==r;++i)n[i]=t[e++];this.targetObject.needsUpdate=!0}_setValue_array_setMatrixWorldNeedsUpdate(t,e){let n=this.resolvedProperty;for(let i=0,r=n.length;i!==r;++i)n[i]=t[e++];this.targetObject.matrixWorldNeedsUpdate=!0}_setValue_arrayElement(t,e){this.resolvedProperty[this.propertyIndex]=t[e]}_setValue_arrayElement_setNeedsUpdate(t,e){this.resolvedProperty[this.propertyIndex]=t[e],this.targetObject.needsUpdate=!0}_setValue_arrayElement_setMatrixWorldNeedsUpdate(t,e){this.resolvedProperty[this.propertyIndex]=t[e],this.targetObject.matrixWorldNeedsUpdate=!0}_setValue_fromArray(t,e){this.resolvedProperty.fromArray(t,e)}_setValue_fromArray_setNeedsUpdate(t,e){this.resolvedProperty.fromArray(t,e),this.targetObject.needsUpdate=!0}_setValue_fromArray_setMatrixWorldNeedsUpdate(t,e){this.resolvedProperty.fromArray(t,e),this.targetObject.matrixWorldNeedsUpdate=!0}_getValue_unbound(t,e){this.bind(),this.getValue(t,e)}_setValue_unbound(t,e){this.bind(),this.setValue(t,e)}bind(){let t=this.node,e=this.parsedPath,n=e.objectName,i=e.propertyName,r=e.propertyIndex;if(t||(t=s.findNode(this.rootNode,e.nodeName),this.node=t),this.getValue=this._getValue_unavailable,this.setValue=this._setValue_unavailable,!t){Yt("PropertyBinding: No target node found for track: "+this.path+".");return}if(n){let c=e.objectIndex;switch(n){case"materials":if(!t.material){te("PropertyBinding: Can not bind to material as node does not have a material.",this);return}if(!t.material.materials){te("PropertyBinding: Can not bind to material.materials as node.material does not have a materials array.",this);return}t=t.material.materials;break;case"bones":if(!t.skeleton){te("PropertyBinding: Can not bind to bones as node does not have a skeleton.",this);return}t=t.skeleton.bones;for(let h=0;h<t.length;h++)if(t[h].name===c){c=h;break}break;case"map":if("map"in t){t=t.map;break}if(!t.material){te("PropertyBinding: Can not bind to material as node does not have a material.",this);return}if(!t.material.map){te("PropertyBinding: Can not bind to material.map as node.material does not have a map.",this);return}t=t.material.map;break;default:if(t[n]===void 0){te("PropertyBinding: Can not bind to objectName of node undefined.",this);return}t=t[n]}if(c!==void 0){if(t[c]===void 0){te("PropertyBinding: Trying to bind to objectIndex of objectName, but is undefined.",this,t);return}t=t[c]}}let o=t[i];if(o===void 0){let c=e.nodeName;te("PropertyBinding: Trying to update property for track: "+c+"."+i+" but it wasn't found.",t);return}let a=this.Versioning.None;this.targetObject=t,t.isMaterial===!0?a=this.Versioning.NeedsUpdate:t.isObject3D===!0&&(a=this.Versioning.MatrixWorldNeedsUpdate);let l=this.BindingType.Direct;if(r!==void 0){if(i==="morphTargetInfluences"){if(!t.geometry){te("PropertyBinding: Can not bind to morphTargetInfluences because node does not have a geometry.",this);return}if(!t.geometry.morphAttributes){te("PropertyBinding: Can not bind to morphTargetInfluences because node does not have a geometry.morphAttributes.",this);return}t.morphTargetDictionary[r]!==void 0&&(r=t.morphTargetDictionary[r])}l=this.BindingType.ArrayElement,this.resolvedProperty=o,this.propertyIndex=r}else o.fromArray!==void 0&&o.toArray!==void 0?(l=this.BindingType.HasFromToArray,this.resolvedProperty=o):Array.isArray(o)?(l=this.BindingType.EntireArray,this.resolvedProperty=o):this.propertyName=i;this.getValue=this.GetterByBindingType[l],this.setValue=this.SetterByBindingTypeAndVersioning[l][a]}unbind(){this.node=null,this.getValue=this._getValue_unbound,this.setValue=this._setValue_unbound}};Ke.Composite=Xp;Ke.prototype.BindingType={Direct:0,EntireArray:1,ArrayElement:2,HasFromToArray:3};Ke.prototype.Versioning={None:0,NeedsUpdate:1,MatrixWorldNeedsUpdate:2};Ke.prototype.GetterByBindingType=[Ke.prototype._getValue_direct,Ke.prototype._getValue_array,Ke.prototype._getValue_arrayElement,Ke.prototype._getValue_toArray];Ke.prototype.SetterByBindingTypeAndVersioning=[[Ke.prototype._setValue_direct,Ke.prototype._setValue_direct_setNeedsUpdate,Ke.prototype._setValue_direct_setMatrixWorldNeedsUpdate],[Ke.prototype._setValue_array,Ke.prototype._setValue_array_setNeedsUpdate,Ke.prototype._setValue_array_setMatrixWorldNeedsUpdate],[Ke.prototype._setValue_arrayElement,Ke.prototype._setValue_arrayElement_setNeedsUpdate,Ke.prototype._setValue_arrayElement_setMatrixWorldNeedsUpdate],[Ke.prototype._setValue_fromArray,Ke.prototype._setValue_fromArray_setNeedsUpdate,Ke.prototype._setValue_fromArray_setMatrixWorldNeedsUpdate]];var VN=new Float32Array(1);var Yi=class extends nu{constructor(t,e,n=1){super(t,e),this.isInstancedInterleavedBuffer=!0,this.meshPerAttribute=n}copy(t){return super.copy(t),this.meshPerAttribute=t.meshPerAttribute,this}clone(t){let e=super.clone(t);return e.meshPerAttribute=this.meshPerAttribute,e}toJSON(t){let e=super.toJSON(t);return e.isInstancedInterleavedBuffer=!0,e.meshPerAttribute=this.meshPerAttribute,e}};var k_=new Nt,ql=class{constructor(t,e,n=0,i=1/0){this.ray=new Ss(t,e),this.near=n,this.far=i,this.camera=null,this.layers=new ma,this.params={Mesh:{},Line:{threshold:1},LOD:{},Points:{threshold:1},Sprite:{}}}set(t,e){this.ray.set(t,e)}setFromCamera(t,e){e.isPerspectiveCamera?(this.ray.origin.setFromMatrixPosition(e.matrixWorld),this.ray.direction.set(t.x,t.y,.5).unproject(e).sub(this.ray.origin).normalize(),this.camera=e):e.isOrthographicCamera?(this.ray.origin.set(t.x,t.y,e.projectionMatrix.elements[14]).unproject(e),this.ray.direction.set(0,0,-1).transformDirection(e.matrixWorld),this.camera=e):te("Raycaster: Unsupported camera type: "+e.type)}setFromXRController(t){return k_.identity().extractRotation(t.matrixWorld),this.ray.origin.setFromMatrixPosition(t.matrixWorld),this.ray.direction.set(0,0,-1).applyMatrix4(k_),this}intersectObject(t,e=!0,n=[]){return qp(t,this,n,e),n.sort(z_),n}intersectObjects(t,e=!0,n=[]){for(let i=0,r=t.length;i<r;i++)qp(t[i],this,n,e);return n.sort(z_),n}};function z_(s,t){return s.distance-t.distance}function qp(s,t,e,n){let i=!0;if(s.layers.test(t.layers)&&s.raycast(t,e)===!1&&(i=!1),i===!0&&n===!0){let r=s.children;for(let o=0,a=r.length;o<a;o++)qp(r[o],t,e,!0)}}var Ta=class{constructor(t=1,e=0,n=0){this.radius=t,this.phi=e,this.theta=n}set(t,e,n){return this.radius=t,this.phi=e,this.theta=n,this}copy(t){return this.radius=t.radius,this.phi=t.phi,this.theta=t.theta,this}makeSafe(){return this.phi=le(this.phi,1e-6,Math.PI-1e-6),this}setFromVector3(t){return this.setFromCartesianCoords(t.x,t.y,t.z)}setFromCartesianCoords(t,e,n){return this.radius=Math.sqrt(t*t+e*e+n*n),this.radius===0?(this.theta=0,this.phi=0):(this.theta=Math.atan2(t,n),this.phi=Math.acos(le(e/this.radius,-1,1))),this}clone(){return new this.constructor().copy(this)}};var jp=class{static{this.prototype.isMatrix2=!0}constructor(t,e,n,i){this.elements=[1,0,0,1],t!==void 0&&this.set(t,e,n,i)}identity(){return this.set(1,0,0,1),this}fromArray(t,e=0){for(let n=0;n<4;n++)this.elements[n]=t[n+e];return this}set(t,e,n,i){let r=this.elements;return r[0]=t,r[2]=e,r[1]=n,r[3]=i,this}};var V_=new F,Vh=new F,ra=new F,oa=new F,Ip=new F,fA=new F,pA=new F,jl=class{constructor(t=new F,e=new F){this.start=t,this.end=e}set(t,e){return this.start.copy(t),this.end.copy(e),this}copy(t){return this.start.copy(t.start),this.end.copy(t.end),this}getCenter(t){return t.addVectors(this.start,this.end).multiplyScalar(.5)}delta(t){return t.subVectors(this.end,this.start)}distanceSq(){return this.start.distanceToSquared(this.end)}distance(){return this.start.distanceTo(this.end)}at(t,e){return this.delta(e).multiplyScalar(t).add(this.start)}closestPointToPointParameter(t,e){V_.subVectors(t,this.start),Vh.subVectors(this.end,this.start);let n=Vh.dot(Vh);if(n===0)return 0;let r=Vh.dot(V_)/n;return e&&(r=le(r,0,1)),r}closestPointToPoint(t,e,n){let i=this.closestPointToPointParameter(t,e);return this.delta(n).multiplyScalar(i).add(this.start)}distanceSqToLine3(t,e=fA,n=pA){let i=10000000000000001e-32,r,o,a=this.start,l=t.start,c=this.end,h=t.end;ra.subVectors(c,a),oa.subVectors(h,l),Ip.subVectors(a,l);let u=ra.dot(ra),d=oa.dot(oa),f=oa.dot(Ip);if(u<=i&&d<=i)return e.copy(a),n.copy(l),e.distanceToSquared(n);if(u<=i)r=0,o=f/d,o=le(o,0,1);else{let m=ra.dot(Ip);if(d<=i)o=0,r=le(-m/u,0,1);else{let y=ra.dot(oa),p=u*d-y*y;p!==0?r=le((y*f-m*d)/p,0,1):r=0,o=(y*r+f)/d,o<0?(o=0,r=le(-m/u,0,1)):o>1&&(o=1,r=le((y-m)/u,0,1))}}return e.copy(a).addScaledVector(ra,r),n.copy(l).addScaledVector(oa,o),e.distanceToSquared(n)}applyMatrix4(t){return this.start.applyMatrix4(t),this.end.applyMatrix4(t),this}equals(t){return t.start.equals(this.start)&&t.end.equals(this.end)}clone(){return new this.constructor().copy(this)}};var Yl=class extends ls{constructor(t,e=null){super(),this.object=t,this.domElement=e,this.enabled=!0,this.state=-1,this.keys={},this.mouseButtons={LEFT:null,MIDDLE:null,RIGHT:null},this.touches={ONE:null,TWO:null}}connect(t){this.domElement!==null&&this.disconnect(),this.domElement=t}disconnect(){}dispose(){}update(){}};function Em(s,t,e,n){let i=mA(n);switch(e){case fm:return s*t;case Su:return s*t/i.components*i.byteLength;case Mu:return s*t/i.components*i.byteLength;case Ir:return s*t*2/i.components*i.byteLength;case wu:return s*t*2/i.components*i.byteLength;case pm:return s*t*3/i.components*i.byteLength;case Ji:return s*t*4/i.components*i.byteLength;case Tu:return s*t*4/i.components*i.byteLength;case Kl:case Zl:return Math.floor((s+3)/4)*Math.floor((t+3)/4)*8;case Ql:case tc:return Math.floor((s+3)/4)*Math.floor((t+3)/4)*16;case Eu:case Ru:return Math.max(s,16)*Math.max(t,8)/4;case Au:case Cu:return Math.max(s,8)*Math.max(t,8)/2;case Pu:case Lu:case Nu:case Du:return Math.floor((s+3)/4)*Math.floor((t+3)/4)*8;case Iu:case ec:case Ou:return Math.floor((s+3)/4)*Math.floor((t+3)/4)*16;case Fu:return Math.floor((s+3)/4)*Math.floor((t+3)/4)*16;case Uu:return Math.floor((s+4)/5)*Math.floor((t+3)/4)*16;case Bu:return Math.floor((s+4)/5)*Math.floor((t+4)/5)*16;case ku:return Math.floor((s+5)/6)*Math.floor((t+4)/5)*16;case zu:return Math.floor((s+5)/6)*Math.floor((t+5)/6)*16;case Vu:return Math.floor((s+7)/8)*Math.floor((t+4)/5)*16;case Gu:return Math.floor((s+7)/8)*Math.floor((t+5)/6)*16;case Hu:return Math.floor((s+7)/8)*Math.floor((t+7)/8)*16;case Wu:return Math.floor((s+9)/10)*Math.floor((t+4)/5)*16;case Xu:return Math.floor((s+9)/10)*Math.floor((t+5)/6)*16;case qu:return Math.floor((s+9)/10)*Math.floor((t+7)/8)*16;case ju:return Math.floor((s+9)/10)*Math.floor((t+9)/10)*16;case Yu:return Math.floor((s+11)/12)*Math.floor((t+9)/10)*16;case $u:return Math.floor((s+11)/12)*Math.floor((t+11)/12)*16;case Ju:case Ku:case Zu:return Math.ceil(s/4)*Math.ceil(t/4)*16;case Qu:case td:return Math.ceil(s/4)*Math.ceil(t/4)*8;case nc:case ed:return Math.ceil(s/4)*Math.ceil(t/4)*16}throw new Error(`Unable to determine texture byte length for ${e} format.`)}function mA(s){switch(s){case Si:case cm:return{byteLength:1,components:1};case Ra:case hm:case ds:return{byteLength:2,components:1};case vu:case bu:return{byteLength:2,components:4};case us:case xu:case ki:return{byteLength:4,components:1};case um:case dm:return{byteLength:4,components:3}}throw new Error(`THREE.TextureUtils: Unknown texture type ${s}.`)}typeof __THREE_DEVTOOLS__<"u"&&__THREE_DEVTOOLS__.dispatchEvent(new CustomEvent("register",{detail:{revision:"187"}}));typeof window<"u"&&(window.__THREE__?Yt("WARNING: Multiple instances of Three.js being imported."):window.__THREE__="187");function Qx(){let s=null,t=!1,e=null,n=null;function i(r,o){n=s.requestAnimationFrame(i),e(r,o)}return{start:function(){t!==!0&&e!==null&&s!==null&&(n=s.requestAnimationFrame(i),t=!0)},stop:function(){s!==null&&s.cancelAnimationFrame(n),t=!1},setAnimationLoop:function(r){e=r},setContext:function(r){s=r}}}function yA(s){let t=new WeakMap;function e(a,l){let c=a.array,h=a.usage,u=c.byteLength,d=s.createBuffer();s.bindBuffer(l,d),s.bufferData(l,c,h),a.onUploadCallback();let f;if(c instanceof Float32Array)f=s.FLOAT;else if(typeof Float16Array<"u"&&c instanceof Float16Array)f=s.HALF_FLOAT;else if(c instanceof Uint16Array)a.isFloat16BufferAttribute?f=s.HALF_FLOAT:f=s.UNSIGNED_SHORT;else if(c instanceof Int16Array)f=s.SHORT;else if(c instanceof Uint32Array)f=s.UNSIGNED_INT;else if(c instanceof Int32Array)f=s.INT;else if(c instanceof Int8Array)f=s.BYTE;else if(c instanceof Uint8Array)f=s.UNSIGNED_BYTE;else if(c instanceof Uint8ClampedArray)f=s.UNSIGNED_BYTE;else throw new Error("THREE.WebGLAttributes: Unsupported buffer data format: "+c);return{buffer:d,type:f,bytesPerElement:c.BYTES_PER_ELEMENT,version:a.version,size:u}}function n(a,l,c){let h=l.array,u=l.updateRanges;if(s.bindBuffer(c,a),u.length===0)s.bufferSubData(c,0,h);else{u.sort((f,m)=>f.start-m.start);let d=0;for(let f=1;f<u.length;f++){let m=u[d],y=u[f];y.start<=m.start+m.count+1?m.count=Math.max(m.count,y.start+y.count-m.start):(++d,u[d]=y)}u.length=d+1;for(let f=0,m=u.length;f<m;f++){let y=u[f];s.bufferSubData(c,y.start*h.BYTES_PER_ELEMENT,h,y.start,y.count)}l.clearUpdateRanges()}l.onUploadCallback()}function i(a){return a.isInterleavedBufferAttribute&&(a=a.data),t.get(a)}function r(a){a.isInterleavedBufferAttribute&&(a=a.data);let l=t.get(a);l&&(s.deleteBuffer(l.buffer),t.delete(a))}function o(a,l){if(a.isInterleavedBufferAttribute&&(a=a.data),a.isGLBufferAttribute){let h=t.get(a);(!h||h.version<a.version)&&t.set(a,{buffer:a.buffer,type:a.type,bytesPerElement:a.elementSize,version:a.version});return}let c=t.get(a);if(c===void 0)t.set(a,e(a,l));else if(c.version<a.version){if(c.size!==a.array.byteLength)throw new Error("THREE.WebGLAttributes: The size of the buffer attribute's array buffer does not match the original size. Resizing buffer attributes is not supported.");n(c.buffer,a,l),c.version=a.version}}return{get:i,remove:r,update:o}}var _A=`#ifdef USE_ALPHAHASH
	if ( diffuseColor.a < getAlphaHashThreshold( vPosition ) ) discard;
#endif`,xA=`#ifdef USE_ALPHAHASH
	const float ALPHA_HASH_SCALE = 0.05;
	float hash2D( vec2 value ) {
		return fract( 1.0e4 * sin( 17.0 * value.x + 0.1 * value.y ) * ( 0.1 + abs( sin( 13.0 * value.y + value.x ) ) ) );
	}
	float hash3D( vec3 value ) {
		return hash2D( vec2( hash2D( value.xy ), value.z ) );
	}
	float getAlphaHashThreshold( vec3 position ) {
		float maxDeriv = max(
			length( dFdx( position.xyz ) ),
			length( dFdy( position.xyz ) )
		);
		float pixScale = 1.0 / ( ALPHA_HASH_SCALE * maxDeriv );
		vec2 pixScales = vec2(
			exp2( floor( log2( pixScale ) ) ),
			exp2( ceil( log2( pixScale ) ) )
		);
		vec2 alpha = vec2(
			hash3D( floor( pixScales.x * position.xyz ) ),
			hash3D( floor( pixScales.y * position.xyz ) )
		);
		float lerpFactor = fract( log2( pixScale ) );
		float x = ( 1.0 - lerpFactor ) * alpha.x + lerpFactor * alpha.y;
		float a = min( lerpFactor, 1.0 - lerpFactor );
		vec3 cases = vec3(
			x * x / ( 2.0 * a * ( 1.0 - a ) ),
			( x - 0.5 * a ) / ( 1.0 - a ),
			1.0 - ( ( 1.0 - x ) * ( 1.0 - x ) / ( 2.0 * a * ( 1.0 - a ) ) )
		);
		float threshold = ( x < ( 1.0 - a ) )
			? ( ( x < a ) ? cases.x : cases.y )
			: cases.z;
		return clamp( threshold , 1.0e-6, 1.0 );
	}
#endif`,vA=`#ifdef USE_ALPHAMAP
	diffuseColor.a *= texture2D( alphaMap, vAlphaMapUv ).g;
#endif`,bA=`#ifdef USE_ALPHAMAP
	uniform sampler2D alphaMap;
#endif`,SA=`#ifdef USE_ALPHATEST
	#ifdef ALPHA_TO_COVERAGE
	diffuseColor.a = smoothstep( alphaTest, alphaTest + fwidth( diffuseColor.a ), diffuseColor.a );
	if ( diffuseColor.a == 0.0 ) discard;
	#else
	if ( diffuseColor.a < alphaTest ) discard;
	#endif
#endif`,MA=`#ifdef USE_ALPHATEST
	uniform float alphaTest;
#endif`,wA=`#ifdef USE_AOMAP
	float ambientOcclusion = ( texture2D( aoMap, vAoMapUv ).r - 1.0 ) * aoMapIntensity + 1.0;
	reflectedLight.indirectDiffuse *= ambientOcclusion;
	#if defined( USE_CLEARCOAT ) 
		clearcoatSpecularIndirect *= ambientOcclusion;
	#endif
	#if defined( USE_SHEEN ) 
		sheenSpecularIndirect *= ambientOcclusion;
	#endif
	#if defined( USE_ENVMAP ) && defined( STANDARD )
		float dotNV = saturate( dot( geometryNormal, geometryViewDir ) );
		reflectedLight.indirectSpecular *= computeSpecularOcclusion( dotNV, ambientOcclusion, material.roughness );
	#endif
#endif`,TA=`#ifdef USE_AOMAP
	uniform sampler2D aoMap;
	uniform float aoMapIntensity;
#endif`,AA=`#ifdef USE_BATCHING
	#if ! defined( GL_ANGLE_multi_draw )
	#define gl_DrawID _gl_DrawID
	uniform int _gl_DrawID;
	#endif
	uniform highp sampler2D batchingTexture;
	uniform highp usampler2D batchingIdTexture;
	mat4 getBatchingMatrix( const in float i ) {
		int size = textureSize( batchingTexture, 0 ).x;
		int j = int( i ) * 4;
		int x = j % size;
		int y = j / size;
		vec4 v1 = texelFetch( batchingTexture, ivec2( x, y ), 0 );
		vec4 v2 = texelFetch( batchingTexture, ivec2( x + 1, y ), 0 );
		vec4 v3 = texelFetch( batchingTexture, ivec2( x + 2, y ), 0 );
		vec4 v4 = texelFetch( batchingTexture, ivec2( x + 3, y ), 0 );
		return mat4( v1, v2, v3, v4 );
	}
	float getIndirectIndex( const in int i ) {
		int size = textureSize( batchingIdTexture, 0 ).x;
		int x = i % size;
		int y = i / size;
		return float( texelFetch( batchingIdTexture, ivec2( x, y ), 0 ).r );
	}
#endif
#ifdef USE_BATCHING_COLOR
	uniform sampler2D batchingColorTexture;
	vec4 getBatchingColor( const in float i ) {
		int size = textureSize( batchingColorTexture, 0 ).x;
		int j = int( i );
		int x = j % size;
		int y = j / size;
		return texelFetch( batchingColorTexture, ivec2( x, y ), 0 );
	}
#endif`,EA=`#ifdef USE_BATCHING
	mat4 batchingMatrix = getBatchingMatrix( getIndirectIndex( gl_DrawID ) );
#endif`,CA=`vec3 transformed = vec3( position );
#ifdef USE_ALPHAHASH
	vPosition = vec3( position );
#endif`,RA=`vec3 objectNormal = vec3( normal );
#ifdef USE_TANGENT
	vec3 objectTangent = vec3( tangent.xyz );
#endif`,PA=`float G_BlinnPhong_Implicit( ) {
	return 0.25;
}
float D_BlinnPhong( const in float shininess, const in float dotNH ) {
	return RECIPROCAL_PI * ( shininess * 0.5 + 1.0 ) * pow( dotNH, shininess );
}
vec3 BRDF_BlinnPhong( const in vec3 lightDir, const in vec3 viewDir, const in vec3 normal, const in vec3 specularColor, const in float shininess ) {
	vec3 halfDir = normalize( lightDir + viewDir );
	float dotNH = saturate( dot( normal, halfDir ) );
	float dotVH = saturate( dot( viewDir, halfDir ) );
	vec3 F = F_Schlick( specularColor, 1.0, dotVH );
	float G = G_BlinnPhong_Implicit( );
	float D = D_BlinnPhong( shininess, dotNH );
	return F * ( G * D );
} // validated`,LA=`#ifdef USE_IRIDESCENCE
	const mat3 XYZ_TO_REC709 = mat3(
		 3.2404542, -0.9692660,  0.0556434,
		-1.5371385,  1.8760108, -0.2040259,
		-0.4985314,  0.0415560,  1.0572252
	);
	vec3 Fresnel0ToIor( vec3 fresnel0 ) {
		vec3 sqrtF0 = sqrt( fresnel0 );
		return ( vec3( 1.0 ) + sqrtF0 ) / ( vec3( 1.0 ) - sqrtF0 );
	}
	vec3 IorToFresnel0( vec3 transmittedIor, float incidentIor ) {
		return pow2( ( transmittedIor - vec3( incidentIor ) ) / ( transmittedIor + vec3( incidentIor ) ) );
	}
	float IorToFresnel0( float transmittedIor, float incidentIor ) {
		return pow2( ( transmittedIor - incidentIor ) / ( transmittedIor + incidentIor ));
	}
	vec3 evalSensitivity( float OPD, vec3 shift ) {
		float phase = 2.0 * PI * OPD * 1.0e-9;
		vec3 val = vec3( 5.4856e-13, 4.4201e-13, 5.2481e-13 );
		vec3 pos = vec3( 1.6810e+06, 1.7953e+06, 2.2084e+06 );
		vec3 var = vec3( 4.3278e+09, 9.3046e+09, 6.6121e+09 );
		vec3 xyz = val * sqrt( 2.0 * PI * var ) * cos( pos * phase + shift ) * exp( - pow2( phase ) * var );
		xyz.x += 9.7470e-14 * sqrt( 2.0 * PI * 4.5282e+09 ) * cos( 2.2399e+06 * phase + shift[ 0 ] ) * exp( - 4.5282e+09 * pow2( phase ) );
		xyz /= 1.0685e-7;
		vec3 rgb = XYZ_TO_REC709 * xyz;
		return rgb;
	}
	vec3 evalIridescence( float outsideIOR, float eta2, float cosTheta1, float thinFilmThickness, vec3 baseF0 ) {
		vec3 I;
		float iridescenceIOR = mix( outsideIOR, eta2, smoothstep( 0.0, 0.03, thinFilmThickness ) );
		float sinTheta2Sq = pow2( outsideIOR / iridescenceIOR ) * ( 1.0 - pow2( cosTheta1 ) );
		float cosTheta2Sq = 1.0 - sinTheta2Sq;
		if ( cosTheta2Sq < 0.0 ) {
			return vec3( 1.0 );
		}
		float cosTheta2 = sqrt( cosTheta2Sq );
		float R0 = IorToFresnel0( iridescenceIOR, outsideIOR );
		float R12 = F_Schlick( R0, 1.0, cosTheta1 );
		float T121 = 1.0 - R12;
		float phi12 = 0.0;
		if ( iridescenceIOR < outsideIOR ) phi12 = PI;
		float phi21 = PI - phi12;
		vec3 baseIOR = Fresnel0ToIor( clamp( baseF0, 0.0, 0.9999 ) );		vec3 R1 = IorToFresnel0( baseIOR, iridescenceIOR );
		vec3 R23 = F_Schlick( R1, 1.0, cosTheta2 );
		vec3 phi23 = vec3( 0.0 );
		if ( baseIOR[ 0 ] < iridescenceIOR ) phi23[ 0 ] = PI;
		if ( baseIOR[ 1 ] < iridescenceIOR ) phi23[ 1 ] = PI;
		if ( baseIOR[ 2 ] < iridescenceIOR ) phi23[ 2 ] = PI;
		float OPD = 2.0 * iridescenceIOR * thinFilmThickness * cosTheta2;
		vec3 phi = vec3( phi21 ) + phi23;
		vec3 R123 = clamp( R12 * R23, 1e-5, 0.9999 );
		vec3 r123 = sqrt( R123 );
		vec3 Rs = pow2( T121 ) * R23 / ( vec3( 1.0 ) - R123 );
		vec3 C0 = R12 + Rs;
		I = C0;
		vec3 Cm = Rs - T121;
		for ( int m = 1; m <= 2; ++ m ) {
			Cm *= r123;
			vec3 Sm = 2.0 * evalSensitivity( float( m ) * OPD, float( m ) * phi );
			I += Cm * Sm;
		}
		return max( I, vec3( 0.0 ) );
	}
#endif`,IA=`#ifdef USE_BUMPMAP
	uniform sampler2D bumpMap;
	uniform float bumpScale;
	vec2 dHdxy_fwd() {
		vec2 dSTdx = dFdx( vBumpMapUv );
		vec2 dSTdy = dFdy( vBumpMapUv );
		float Hll = bumpScale * texture2D( bumpMap, vBumpMapUv ).x;
		float dBx = bumpScale * texture2D( bumpMap, vBumpMapUv + dSTdx ).x - Hll;
		float dBy = bumpScale * texture2D( bumpMap, vBumpMapUv + dSTdy ).x - Hll;
		return vec2( dBx, dBy );
	}
	vec3 perturbNormalArb( vec3 surf_pos, vec3 surf_norm, vec2 dHdxy, float faceDirection ) {
		vec3 vSigmaX = normalize( dFdx( surf_pos.xyz ) );
		vec3 vSigmaY = normalize( dFdy( surf_pos.xyz ) );
		vec3 vN = surf_norm;
		vec3 R1 = cross( vSigmaY, vN );
		vec3 R2 = cross( vN, vSigmaX );
		float fDet = dot( vSigmaX, R1 ) * faceDirection;
		vec3 vGrad = sign( fDet ) * ( dHdxy.x * R1 + dHdxy.y * R2 );
		return normalize( abs( fDet ) * surf_norm - vGrad );
	}
#endif`,NA=`#if NUM_CLIPPING_PLANES > 0
	vec4 plane;
	#ifdef ALPHA_TO_COVERAGE
		float distanceToPlane, distanceGradient;
		float clipOpacity = 1.0;
		#pragma unroll_loop_start
		for ( int i = 0; i < UNION_CLIPPING_PLANES; i ++ ) {
			plane = clippingPlanes[ i ];
			distanceToPlane = - dot( vClipPosition, plane.xyz ) + plane.w;
			distanceGradient = fwidth( distanceToPlane ) / 2.0;
			clipOpacity *= smoothstep( - distanceGradient, distanceGradient, distanceToPlane );
			if ( clipOpacity == 0.0 ) discard;
		}
		#pragma unroll_loop_end
		#if UNION_CLIPPING_PLANES < NUM_CLIPPING_PLANES
			float unionClipOpacity = 1.0;
			#pragma unroll_loop_start
			for ( int i = UNION_CLIPPING_PLANES; i < NUM_CLIPPING_PLANES; i ++ ) {
				plane = clippingPlanes[ i ];
				distanceToPlane = - dot( vClipPosition, plane.xyz ) + plane.w;
				distanceGradient = fwidth( distanceToPlane ) / 2.0;
				unionClipOpacity *= 1.0 - smoothstep( - distanceGradient, distanceGradient, distanceToPlane );
			}
			#pragma unroll_loop_end
			clipOpacity *= 1.0 - unionClipOpacity;
		#endif
		diffuseColor.a *= clipOpacity;
		if ( diffuseColor.a == 0.0 ) discard;
	#else
		#pragma unroll_loop_start
		for ( int i = 0; i < UNION_CLIPPING_PLANES; i ++ ) {
			plane = clippingPlanes[ i ];
			if ( dot( vClipPosition, plane.xyz ) > plane.w ) discard;
		}
		#pragma unroll_loop_end
		#if UNION_CLIPPING_PLANES < NUM_CLIPPING_PLANES
			bool clipped = true;
			#pragma unroll_loop_start
			for ( int i = UNION_CLIPPING_PLANES; i < NUM_CLIPPING_PLANES; i ++ ) {
				plane = clippingPlanes[ i ];
				clipped = ( dot( vClipPosition, plane.xyz ) > plane.w ) && clipped;
			}
			#pragma unroll_loop_end
			if ( clipped ) discard;
		#endif
	#endif
#endif`,DA=`#if NUM_CLIPPING_PLANES > 0
	varying vec3 vClipPosition;
	uniform vec4 clippingPlanes[ NUM_CLIPPING_PLANES ];
#endif`,OA=`#if NUM_CLIPPING_PLANES > 0
	varying vec3 vClipPosition;
#endif`,FA=`#if NUM_CLIPPING_PLANES > 0
	vClipPosition = - mvPosition.xyz;
#endif`,UA=`#if defined( USE_COLOR ) || defined( USE_COLOR_ALPHA )
	diffuseColor *= vColor;
#endif`,BA=`#if defined( USE_COLOR ) || defined( USE_COLOR_ALPHA )
	varying vec4 vColor;
#endif`,kA=`#if defined( USE_COLOR ) || defined( USE_COLOR_ALPHA ) || defined( USE_INSTANCING_COLOR ) || defined( USE_BATCHING_COLOR )
	varying vec4 vColor;
#endif`,zA=`#if defined( USE_COLOR ) || defined( USE_COLOR_ALPHA ) || defined( USE_INSTANCING_COLOR ) || defined( USE_BATCHING_COLOR )
	vColor = vec4( 1.0 );
#endif
#ifdef USE_COLOR_ALPHA
	vColor *= color;
#elif defined( USE_COLOR )
	vColor.rgb *= color;
#endif
#ifdef USE_INSTANCING_COLOR
	vColor.rgb *= instanceColor.rgb;
#endif
#ifdef USE_BATCHING_COLOR
	vColor *= getBatchingColor( getIndirectIndex( gl_DrawID ) );
#endif`,VA=`#define PI 3.141592653589793
#define PI2 6.283185307179586
#define PI_HALF 1.5707963267948966
#define RECIPROCAL_PI 0.3183098861837907
#define RECIPROCAL_PI2 0.15915494309189535
#define EPSILON 1e-6
#ifndef saturate
#define saturate( a ) clamp( a, 0.0, 1.0 )
#endif
#define whiteComplement( a ) ( 1.0 - saturate( a ) )
float pow2( const in float x ) { return x*x; }
vec3 pow2( const in vec3 x ) { return x*x; }
float pow3( const in float x ) { return x*x*x; }
float pow4( const in float x ) { float x2 = x*x; return x2*x2; }
float max3( const in vec3 v ) { return max( max( v.x, v.y ), v.z ); }
float average( const in vec3 v ) { return dot( v, vec3( 0.3333333 ) ); }
highp float rand( const in vec2 uv ) {
	const highp float a = 12.9898, b = 78.233, c = 43758.5453;
	highp float dt = dot( uv.xy, vec2( a,b ) ), sn = mod( dt, PI );
	return fract( sin( sn ) * c );
}
#ifdef HIGH_PRECISION
	float precisionSafeLength( vec3 v ) { return length( v ); }
#else
	float precisionSafeLength( vec3 v ) {
		float maxComponent = max3( abs( v ) );
		return length( v / maxComponent ) * maxComponent;
	}
#endif
struct IncidentLight {
	vec3 color;
	vec3 direction;
	bool visible;
};
struct ReflectedLight {
	vec3 directDiffuse;
	vec3 directSpecular;
	vec3 indirectDiffuse;
	vec3 indirectSpecular;
};
#ifdef USE_ALPHAHASH
	varying vec3 vPosition;
#endif
vec3 transformDirection( in vec3 dir, in mat4 matrix ) {
	return normalize( ( matrix * vec4( dir, 0.0 ) ).xyz );
}
#define inverseTransformDirection transformDirectionByInverseViewMatrix
vec3 transformNormalByInverseViewMatrix( in vec3 normal, in mat4 viewMatrix ) {
	return normalize( ( vec4( normal, 0.0 ) * viewMatrix ).xyz );
}
vec3 transformDirectionByInverseViewMatrix( in vec3 dir, in mat4 viewMatrix ) {
	return normalize( ( vec4( dir, 0.0 ) * viewMatrix ).xyz );
}
bool isPerspectiveMatrix( mat4 m ) {
	return m[ 2 ][ 3 ] == - 1.0;
}
vec2 equirectUv( in vec3 dir ) {
	float u = atan( dir.z, dir.x ) * RECIPROCAL_PI2 + 0.5;
	float v = asin( clamp( dir.y, - 1.0, 1.0 ) ) * RECIPROCAL_PI + 0.5;
	return vec2( u, v );
}
vec3 BRDF_Lambert( const in vec3 diffuseColor ) {
	return RECIPROCAL_PI * diffuseColor;
}
vec3 F_Schlick( const in vec3 f0, const in float f90, const in float dotVH ) {
	float fresnel = exp2( ( - 5.55473 * dotVH - 6.98316 ) * dotVH );
	return f0 * ( 1.0 - fresnel ) + ( f90 * fresnel );
}
float F_Schlick( const in float f0, const in float f90, const in float dotVH ) {
	float fresnel = exp2( ( - 5.55473 * dotVH - 6.98316 ) * dotVH );
	return f0 * ( 1.0 - fresnel ) + ( f90 * fresnel );
} // validated`,GA=`vec3 transformedNormal = objectNormal;
#ifdef USE_TANGENT
	vec3 transformedTangent = objectTangent;
#endif
#ifdef USE_BATCHING
	mat3 bm = mat3( batchingMatrix );
	transformedNormal /= vec3( dot( bm[ 0 ], bm[ 0 ] ), dot( bm[ 1 ], bm[ 1 ] ), dot( bm[ 2 ], bm[ 2 ] ) );
	transformedNormal = bm * transformedNormal;
	#ifdef USE_TANGENT
		transformedTangent = bm * transformedTangent;
	#endif
#endif
#ifdef USE_INSTANCING
	mat3 im = mat3( instanceMatrix );
	transformedNormal /= vec3( dot( im[ 0 ], im[ 0 ] ), dot( im[ 1 ], im[ 1 ] ), dot( im[ 2 ], im[ 2 ] ) );
	transformedNormal = im * transformedNormal;
	#ifdef USE_TANGENT
		transformedTangent = im * transformedTangent;
	#endif
#endif
transformedNormal = normalMatrix * transformedNormal;
#ifdef FLIP_SIDED
	transformedNormal = - transformedNormal;
#endif
#ifdef USE_TANGENT
	transformedTangent = ( modelViewMatrix * vec4( transformedTangent, 0.0 ) ).xyz;
#endif`,HA=`#ifdef USE_DISPLACEMENTMAP
	uniform sampler2D displacementMap;
	uniform float displacementScale;
	uniform float displacementBias;
#endif`,WA=`#ifdef USE_DISPLACEMENTMAP
	transformed += normalize( objectNormal ) * ( texture2D( displacementMap, vDisplacementMapUv ).x * displacementScale + displacementBias );
#endif`,XA=`#ifdef USE_EMISSIVEMAP
	vec4 emissiveColor = texture2D( emissiveMap, vEmissiveMapUv );
	#ifdef DECODE_VIDEO_TEXTURE_EMISSIVE
		emissiveColor = sRGBTransferEOTF( emissiveColor );
	#endif
	totalEmissiveRadiance *= emissiveColor.rgb;
#endif`,qA=`#ifdef USE_EMISSIVEMAP
	uniform sampler2D emissiveMap;
#endif`,jA="gl_FragColor = linearToOutputTexel( gl_FragColor );",YA=`vec4 LinearTransferOETF( in vec4 value ) {
	return value;
}
vec4 sRGBTransferEOTF( in vec4 value ) {
	return vec4( mix( pow( value.rgb * 0.9478672986 + vec3( 0.0521327014 ), vec3( 2.4 ) ), value.rgb * 0.0773993808, vec3( lessThanEqual( value.rgb, vec3( 0.04045 ) ) ) ), value.a );
}
vec4 sRGBTransferOETF( in vec4 value ) {
	return vec4( mix( pow( value.rgb, vec3( 0.41666 ) ) * 1.055 - vec3( 0.055 ), value.rgb * 12.92, vec3( lessThanEqual( value.rgb, vec3( 0.0031308 ) ) ) ), value.a );
}`,$A=`#ifdef USE_ENVMAP
	#ifdef ENV_WORLDPOS
		vec3 cameraToFrag;
		if ( isOrthographic ) {
			cameraToFrag = normalize( vec3( - viewMatrix[ 0 ][ 2 ], - viewMatrix[ 1 ][ 2 ], - viewMatrix[ 2 ][ 2 ] ) );
		} else {
			cameraToFrag = normalize( vWorldPosition - cameraPosition );
		}
		vec3 worldNormal = transformNormalByInverseViewMatrix( normal, viewMatrix );
		#ifdef ENVMAP_MODE_REFLECTION
			vec3 reflectVec = reflect( cameraToFrag, worldNormal );
		#else
			vec3 reflectVec = refract( cameraToFrag, worldNormal, refractionRatio );
		#endif
	#else
		vec3 reflectVec = vReflect;
	#endif
	#ifdef ENVMAP_TYPE_CUBE
		vec4 envColor = textureCube( envMap, envMapRotation * reflectVec );
		#ifdef ENVMAP_BLENDING_MULTIPLY
			outgoingLight = mix( outgoingLight, outgoingLight * envColor.xyz, specularStrength * reflectivity );
		#elif defined( ENVMAP_BLENDING_MIX )
			outgoingLight = mix( outgoingLight, envColor.xyz, specularStrength * reflectivity );
		#elif defined( ENVMAP_BLENDING_ADD )
			outgoingLight += envColor.xyz * specularStrength * reflectivity;
		#endif
	#endif
#endif`,JA=`#ifdef USE_ENVMAP
	uniform float envMapIntensity;
	uniform mat3 envMapRotation;
	uniform samplerCube envMap;
	#ifdef ENVMAP_TYPE_PMREM
		float roughnessToMip( const in float roughness ) {
			float r = clamp( roughness, 0.0, 1.0 );
			return ENVMAP_MAX_LOD * r * ( 2.0 - r );
		}
	#endif
#endif`,KA=`#ifdef USE_ENVMAP
	uniform float reflectivity;
	#if defined( USE_BUMPMAP ) || defined( USE_NORMALMAP ) || defined( PHONG ) || defined( LAMBERT )
		#define ENV_WORLDPOS
	#endif
	#ifdef ENV_WORLDPOS
		varying vec3 vWorldPosition;
		uniform float refractionRatio;
	#else
		varying vec3 vReflect;
	#endif
#endif`,ZA=`#ifdef USE_ENVMAP
	#if defined( USE_BUMPMAP ) || defined( USE_NORMALMAP ) || defined( PHONG ) || defined( LAMBERT )
		#define ENV_WORLDPOS
	#endif
	#ifdef ENV_WORLDPOS
		
		varying vec3 vWorldPosition;
	#else
		varying vec3 vReflect;
		uniform float refractionRatio;
	#endif
#endif`,QA=`#ifdef USE_ENVMAP
	#ifdef ENV_WORLDPOS
		vWorldPosition = worldPosition.xyz;
	#else
		vec3 cameraToVertex;
		if ( isOrthographic ) {
			cameraToVertex = normalize( vec3( - viewMatrix[ 0 ][ 2 ], - viewMatrix[ 1 ][ 2 ], - viewMatrix[ 2 ][ 2 ] ) );
		} else {
			cameraToVertex = normalize( worldPosition.xyz - cameraPosition );
		}
		vec3 worldNormal = transformNormalByInverseViewMatrix( transformedNormal, viewMatrix );
		#ifdef ENVMAP_MODE_REFLECTION
			vReflect = reflect( cameraToVertex, worldNormal );
		#else
			vReflect = refract( cameraToVertex, worldNormal, refractionRatio );
		#endif
	#endif
#endif`,tE=`#ifdef USE_FOG
	vFogDepth = - mvPosition.z;
#endif`,eE=`#ifdef USE_FOG
	varying float vFogDepth;
#endif`,nE=`#ifdef USE_FOG
	#ifdef FOG_EXP2
		float fogFactor = 1.0 - exp( - fogDensity * fogDensity * vFogDepth * vFogDepth );
	#else
		float fogFactor = smoothstep( fogNear, fogFar, vFogDepth );
	#endif
	gl_FragColor.rgb = mix( gl_FragColor.rgb, fogColor, fogFactor );
#endif`,iE=`#ifdef USE_FOG
	uniform vec3 fogColor;
	varying float vFogDepth;
	#ifdef FOG_EXP2
		uniform float fogDensity;
	#else
		uniform float fogNear;
		uniform float fogFar;
	#endif
#endif`,sE=`#ifdef USE_GRADIENTMAP
	uniform sampler2D gradientMap;
#endif
vec3 getGradientIrradiance( vec3 normal, vec3 lightDirection ) {
	float dotNL = dot( normal, lightDirection );
	vec2 coord = vec2( dotNL * 0.5 + 0.5, 0.0 );
	#ifdef USE_GRADIENTMAP
		return vec3( texture2D( gradientMap, coord ).r );
	#else
		vec2 fw = fwidth( coord ) * 0.5;
		return mix( vec3( 0.7 ), vec3( 1.0 ), smoothstep( 0.7 - fw.x, 0.7 + fw.x, coord.x ) );
	#endif
}`,rE=`#ifdef USE_LIGHTMAP
	uniform sampler2D lightMap;
	uniform float lightMapIntensity;
#endif`,oE=`LambertMaterial material;
material.diffuseColor = diffuseColor.rgb;
material.specularStrength = specularStrength;`,aE=`varying vec3 vViewPosition;
struct LambertMaterial {
	vec3 diffuseColor;
	float specularStrength;
};
void RE_Direct_Lambert( const in IncidentLight directLight, const in vec3 geometryPosition, const in vec3 geometryNormal, const in vec3 geometryViewDir, const in vec3 geometryClearcoatNormal, const in LambertMaterial material, inout ReflectedLight reflectedLight ) {
	float dotNL = saturate( dot( geometryNormal, directLight.direction ) );
	vec3 irradiance = dotNL * directLight.color;
	reflectedLight.directDiffuse += irradiance * BRDF_Lambert( material.diffuseColor );
}
void RE_IndirectDiffuse_Lambert( const in vec3 irradiance, const in vec3 geometryPosition, const in vec3 geometryNormal, const in vec3 geometryViewDir, const in vec3 geometryClearcoatNormal, const in LambertMaterial material, inout ReflectedLight reflectedLight ) {
	reflectedLight.indirectDiffuse += irradiance * BRDF_Lambert( material.diffuseColor );
}
#define RE_Direct				RE_Direct_Lambert
#define RE_IndirectDiffuse		RE_IndirectDiffuse_Lambert`,lE=`uniform bool receiveShadow;
uniform vec3 ambientLightColor;
#if defined( USE_LIGHT_PROBES )
	uniform vec3 lightProbe[ 9 ];
#endif
vec3 shGetIrradianceAt( in vec3 normal, in vec3 shCoefficients[ 9 ] ) {
	float x = normal.x, y = normal.y, z = normal.z;
	vec3 result = shCoefficients[ 0 ] * 0.886227;
	result += shCoefficients[ 1 ] * 2.0 * 0.511664 * y;
	result += shCoefficients[ 2 ] * 2.0 * 0.511664 * z;
	result += shCoefficients[ 3 ] * 2.0 * 0.511664 * x;
	result += shCoefficients[ 4 ] * 2.0 * 0.429043 * x * y;
	result += shCoefficients[ 5 ] * 2.0 * 0.429043 * y * z;
	result += shCoefficients[ 6 ] * ( 0.743125 * z * z - 0.247708 );
	result += shCoefficients[ 7 ] * 2.0 * 0.429043 * x * z;
	result += shCoefficients[ 8 ] * 0.429043 * ( x * x - y * y );
	return result;
}
vec3 getLightProbeIrradiance( const in vec3 lightProbe[ 9 ], const in vec3 normal ) {
	vec3 worldNormal = transformNormalByInverseViewMatrix( normal, viewMatrix );
	vec3 irradiance = shGetIrradianceAt( worldNormal, lightProbe );
	return irradiance;
}
vec3 getAmbientLightIrradiance( const in vec3 ambientLightColor ) {
	vec3 irradiance = ambientLightColor;
	return irradiance;
}
float getDistanceAttenuation( const in float lightDistance, const in float cutoffDistance, const in float decayExponent ) {
	float distanceFalloff = 1.0 / max( pow( lightDistance, decayExponent ), 0.01 );
	if ( cutoffDistance > 0.0 ) {
		distanceFalloff *= pow2( saturate( 1.0 - pow4( lightDistance / cutoffDistance ) ) );
	}
	return distanceFalloff;
}
float getSpotAttenuation( const in float coneCosine, const in float penumbraCosine, const in float angleCosine ) {
	return smoothstep( coneCosine, penumbraCosine, angleCosine );
}
#if NUM_SUN_LIGHTS > 0
	struct SunLight {
		vec3 direction;
		vec3 color;
	};
	uniform SunLight sunLights[ NUM_SUN_LIGHTS ];
	void getSunLightInfo( const in SunLight sunLight, out IncidentLight light ) {
		light.color = sunLight.color;
		light.direction = sunLight.direction;
		light.visible = true;
	}
#endif
#if NUM_DIR_LIGHTS > 0
	struct DirectionalLight {
		vec3 direction;
		vec3 color;
	};
	uniform DirectionalLight directionalLights[ NUM_DIR_LIGHTS ];
	void getDirectionalLightInfo( const in DirectionalLight directionalLight, out IncidentLight light ) {
		light.color = directionalLight.color;
		light.direction = directionalLight.direction;
		light.visible = true;
	}
#endif
#if NUM_POINT_LIGHTS > 0
	struct PointLight {
		vec3 position;
		vec3 color;
		float distance;
		float decay;
	};
	uniform PointLight pointLights[ NUM_POINT_LIGHTS ];
	void getPointLightInfo( const in PointLight pointLight, const in vec3 geometryPosition, out IncidentLight light ) {
		vec3 lVector = pointLight.position - geometryPosition;
		light.direction = normalize( lVector );
		float lightDistance = length( lVector );
		light.color = pointLight.color;
		light.color *= getDistanceAttenuation( lightDistance, pointLight.distance, pointLight.decay );
		light.visible = ( light.color != vec3( 0.0 ) );
	}
#endif
#if NUM_SPOT_LIGHTS > 0
	struct SpotLight {
		vec3 position;
		vec3 direction;
		vec3 color;
		float distance;
		float decay;
		float coneCos;
		float penumbraCos;
	};
	uniform SpotLight spotLights[ NUM_SPOT_LIGHTS ];
	void getSpotLightInfo( const in SpotLight spotLight, const in vec3 geometryPosition, out IncidentLight light ) {
		vec3 lVector = spotLight.position - geometryPosition;
		light.direction = normalize( lVector );
		float angleCos = dot( light.direction, spotLight.direction );
		float spotAttenuation = getSpotAttenuation( spotLight.coneCos, spotLight.penumbraCos, angleCos );
		if ( spotAttenuation > 0.0 ) {
			float lightDistance = length( lVector );
			light.color = spotLight.color * spotAttenuation;
			light.color *= getDistanceAttenuation( lightDistance, spotLight.distance, spotLight.decay );
			light.visible = ( light.color != vec3( 0.0 ) );
		} else {
			light.color = vec3( 0.0 );
			light.visible = false;
		}
	}
#endif
#if NUM_RECT_AREA_LIGHTS > 0
	struct RectAreaLight {
		vec3 color;
		vec3 position;
		vec3 halfWidth;
		vec3 halfHeight;
	};
	uniform sampler2D ltc_1;	uniform sampler2D ltc_2;
	uniform RectAreaLight rectAreaLights[ NUM_RECT_AREA_LIGHTS ];
#endif
#if NUM_HEMI_LIGHTS > 0
	struct HemisphereLight {
		vec3 direction;
		vec3 skyColor;
		vec3 groundColor;
	};
	uniform HemisphereLight hemisphereLights[ NUM_HEMI_LIGHTS ];
	vec3 getHemisphereLightIrradiance( const in HemisphereLight hemiLight, const in vec3 normal ) {
		float dotNL = dot( normal, hemiLight.direction );
		float hemiDiffuseWeight = 0.5 * dotNL + 0.5;
		vec3 irradiance = mix( hemiLight.groundColor, hemiLight.skyColor, hemiDiffuseWeight );
		return irradiance;
	}
#endif
#include <lightprobes_pars_fragment>`,cE=`#ifdef USE_ENVMAP
	vec3 getIBLIrradiance( const in vec3 normal ) {
		#ifdef ENVMAP_TYPE_PMREM
			vec3 worldNormal = transformNormalByInverseViewMatrix( normal, viewMatrix );
			vec4 envMapColor = textureLod( envMap, envMapRotation * worldNormal, ENVMAP_MAX_LOD );
			return PI * envMapColor.rgb * envMapIntensity;
		#else
			return vec3( 0.0 );
		#endif
	}
	vec3 getIBLRadiance( const in vec3 viewDir, const in vec3 normal, const in float roughness ) {
		#ifdef ENVMAP_TYPE_PMREM
			vec3 reflectVec = reflect( - viewDir, normal );
			reflectVec = normalize( mix( reflectVec, normal, pow4( roughness ) ) );
			reflectVec = transformDirectionByInverseViewMatrix( reflectVec, viewMatrix );
			vec4 envMapColor = textureLod( envMap, envMapRotation * reflectVec, roughnessToMip( roughness ) );
			return envMapColor.rgb * envMapIntensity;
		#else
			return vec3( 0.0 );
		#endif
	}
	#ifdef USE_RETROREFLECTION
		vec3 getIBLRetroRadiance( const in vec3 viewDir, const in vec3 normal, const in float roughness ) {
			#ifdef ENVMAP_TYPE_PMREM
				vec3 retroVec = normalize( mix( viewDir, normal, pow4( roughness ) ) );
				retroVec = transformDirectionByInverseViewMatrix( retroVec, viewMatrix );
				vec4 envMapColor = textureLod( envMap, envMapRotation * retroVec, roughnessToMip( roughness ) );
				return envMapColor.rgb * envMapIntensity;
			#else
				return vec3( 0.0 );
			#endif
		}
	#endif
	#ifdef USE_ANISOTROPY
		vec3 getIBLAnisotropyRadiance( const in vec3 viewDir, const in vec3 normal, const in float roughness, const in vec3 bitangent, const in float anisotropy ) {
			#ifdef ENVMAP_TYPE_PMREM
				vec3 bentNormal = cross( bitangent, viewDir );
				bentNormal = normalize( cross( bentNormal, bitangent ) );
				bentNormal = normalize( mix( bentNormal, normal, pow2( pow2( 1.0 - anisotropy * ( 1.0 - roughness ) ) ) ) );
				return getIBLRadiance( viewDir, bentNormal, roughness );
			#else
				return vec3( 0.0 );
			#endif
		}
		#ifdef USE_RETROREFLECTION
			vec3 getIBLAnisotropyRetroRadiance( const in vec3 viewDir, const in vec3 normal, const in float roughness, const in vec3 bitangent, const in float anisotropy ) {
				#ifdef ENVMAP_TYPE_PMREM
					vec3 bentNormal = cross( bitangent, viewDir );
					bentNormal = normalize( cross( bentNormal, bitangent ) );
					bentNormal = normalize( mix( bentNormal, normal, pow2( pow2( 1.0 - anisotropy * ( 1.0 - roughness ) ) ) ) );
					return getIBLRetroRadiance( viewDir, bentNormal, roughness );
				#else
					return vec3( 0.0 );
				#endif
			}
		#endif
	#endif
#endif`,hE=`ToonMaterial material;
material.diffuseColor = diffuseColor.rgb;`,uE=`varying vec3 vViewPosition;
struct ToonMaterial {
	vec3 diffuseColor;
};
void RE_Direct_Toon( const in IncidentLight directLight, const in vec3 geometryPosition, const in vec3 geometryNormal, const in vec3 geometryViewDir, const in vec3 geometryClearcoatNormal, const in ToonMaterial material, inout ReflectedLight reflectedLight ) {
	vec3 irradiance = getGradientIrradiance( geometryNormal, directLight.direction ) * directLight.color;
	reflectedLight.directDiffuse += irradiance * BRDF_Lambert( material.diffuseColor );
}
void RE_IndirectDiffuse_Toon( const in vec3 irradiance, const in vec3 geometryPosition, const in vec3 geometryNormal, const in vec3 geometryViewDir, const in vec3 geometryClearcoatNormal, const in ToonMaterial material, inout ReflectedLight reflectedLight ) {
	reflectedLight.indirectDiffuse += irradiance * BRDF_Lambert( material.diffuseColor );
}
#define RE_Direct				RE_Direct_Toon
#define RE_IndirectDiffuse		RE_IndirectDiffuse_Toon`,dE=`BlinnPhongMaterial material;
material.diffuseColor = diffuseColor.rgb;
material.specularColor = specular;
material.specularShininess = shininess;
material.specularStrength = specularStrength;`,fE=`varying vec3 vViewPosition;
struct BlinnPhongMaterial {
	vec3 diffuseColor;
	vec3 specularColor;
	float specularShininess;
	float specularStrength;
};
void RE_Direct_BlinnPhong( const in IncidentLight directLight, const in vec3 geometryPosition, const in vec3 geometryNormal, const in vec3 geometryViewDir, const in vec3 geometryClearcoatNormal, const in BlinnPhongMaterial material, inout ReflectedLight reflectedLight ) {
	float dotNL = saturate( dot( geometryNormal, directLight.direction ) );
	vec3 irradiance = dotNL * directLight.color;
	reflectedLight.directDiffuse += irradiance * BRDF_Lambert( material.diffuseColor );
	reflectedLight.directSpecular += irradiance * BRDF_BlinnPhong( directLight.direction, geometryViewDir, geometryNormal, material.specularColor, material.specularShininess ) * material.specularStrength;
}
void RE_IndirectDiffuse_BlinnPhong( const in vec3 irradiance, const in vec3 geometryPosition, const in vec3 geometryNormal, const in vec3 geometryViewDir, const in vec3 geometryClearcoatNormal, const in BlinnPhongMaterial material, inout ReflectedLight reflectedLight ) {
	reflectedLight.indirectDiffuse += irradiance * BRDF_Lambert( material.diffuseColor );
}
#define RE_Direct				RE_Direct_BlinnPhong
#define RE_IndirectDiffuse		RE_IndirectDiffuse_BlinnPhong`,pE=`PhysicalMaterial material;
material.diffuseColor = diffuseColor.rgb;
material.diffuseContribution = diffuseColor.rgb * ( 1.0 - metalnessFactor );
material.metalness = metalnessFactor;
vec3 dxy = max( abs( dFdx( nonPerturbedNormal ) ), abs( dFdy( nonPerturbedNormal ) ) );
float geometryRoughness = max( max( dxy.x, dxy.y ), dxy.z );
material.roughness = max( roughnessFactor, 0.045 );
material.roughness += geometryRoughness;
material.roughness = min( material.roughness, 1.0 );
#ifdef USE_DIFFUSE_ROUGHNESS
	float diffuseRoughnessFactor = diffuseRoughness;
	#ifdef USE_DIFFUSE_ROUGHNESSMAP
		diffuseRoughnessFactor *= texture2D( diffuseRoughnessMap, vDiffuseRoughnessMapUv ).r;
	#endif
	material.diffuseRoughness = saturate( diffuseRoughnessFactor );
#endif
#ifdef IOR
	material.ior = ior;
	#ifdef USE_SPECULAR
		float specularIntensityFactor = specularIntensity;
		vec3 specularColorFactor = specularColor;
		#ifdef USE_SPECULAR_COLORMAP
			specularColorFactor *= texture2D( specularColorMap, vSpecularColorMapUv ).rgb;
		#endif
		#ifdef USE_SPECULAR_INTENSITYMAP
			specularIntensityFactor *= texture2D( specularIntensityMap, vSpecularIntensityMapUv ).a;
		#endif
		material.specularF90 = mix( specularIntensityFactor, 1.0, metalnessFactor );
	#else
		float specularIntensityFactor = 1.0;
		vec3 specularColorFactor = vec3( 1.0 );
		material.specularF90 = 1.0;
	#endif
	material.specularColor = min( pow2( ( material.ior - 1.0 ) / ( material.ior + 1.0 ) ) * specularColorFactor, vec3( 1.0 ) ) * specularIntensityFactor;
	material.specularColorBlended = mix( material.specularColor, diffuseColor.rgb, metalnessFactor );
#else
	material.specularColor = vec3( 0.04 );
	material.specularColorBlended = mix( material.specularColor, diffuseColor.rgb, metalnessFactor );
	material.specularF90 = 1.0;
#endif
#ifdef USE_CLEARCOAT
	material.clearcoat = clearcoat;
	material.clearcoatRoughness = clearcoatRoughness;
	material.clearcoatF0 = vec3( 0.04 );
	material.clearcoatF90 = 1.0;
	#ifdef USE_CLEARCOATMAP
		material.clearcoat *= texture2D( clearcoatMap, vClearcoatMapUv ).x;
	#endif
	#ifdef USE_CLEARCOAT_ROUGHNESSMAP
		material.clearcoatRoughness *= texture2D( clearcoatRoughnessMap, vClearcoatRoughnessMapUv ).y;
	#endif
	material.clearcoat = saturate( material.clearcoat );	material.clearcoatRoughness = max( material.clearcoatRoughness, 0.045 );
	material.clearcoatRoughness += geometryRoughness;
	material.clearcoatRoughness = min( material.clearcoatRoughness, 1.0 );
#endif
#ifdef USE_DISPERSION
	material.dispersion = dispersion;
#endif
#ifdef USE_RETROREFLECTION
	material.retroreflectivity = retroreflectivity;
#endif
#ifdef USE_IRIDESCENCE
	material.iridescence = iridescence;
	material.iridescenceIOR = iridescenceIOR;
	#ifdef USE_IRIDESCENCEMAP
		material.iridescence *= texture2D( iridescenceMap, vIridescenceMapUv ).r;
	#endif
	#ifdef USE_IRIDESCENCE_THICKNESSMAP
		material.iridescenceThickness = (iridescenceThicknessMaximum - iridescenceThicknessMinimum) * texture2D( iridescenceThicknessMap, vIridescenceThicknessMapUv ).g + iridescenceThicknessMinimum;
	#else
		material.iridescenceThickness = iridescenceThicknessMaximum;
	#endif
#endif
#ifdef USE_SHEEN
	material.sheenColor = sheenColor;
	#ifdef USE_SHEEN_COLORMAP
		material.sheenColor *= texture2D( sheenColorMap, vSheenColorMapUv ).rgb;
	#endif
	material.sheenRoughness = clamp( sheenRoughness, 0.0001, 1.0 );
	#ifdef USE_SHEEN_ROUGHNESSMAP
		material.sheenRoughness *= texture2D( sheenRoughnessMap, vSheenRoughnessMapUv ).a;
	#endif
#endif
#ifdef USE_ANISOTROPY
	#ifdef USE_ANISOTROPYMAP
		mat2 anisotropyMat = mat2( anisotropyVector.x, anisotropyVector.y, - anisotropyVector.y, anisotropyVector.x );
		vec3 anisotropyPolar = texture2D( anisotropyMap, vAnisotropyMapUv ).rgb;
		vec2 anisotropyV = anisotropyMat * normalize( 2.0 * anisotropyPolar.rg - vec2( 1.0 ) ) * anisotropyPolar.b;
	#else
		vec2 anisotropyV = anisotropyVector;
	#endif
	material.anisotropy = length( anisotropyV );
	if( material.anisotropy == 0.0 ) {
		anisotropyV = vec2( 1.0, 0.0 );
	} else {
		anisotropyV /= material.anisotropy;
		material.anisotropy = saturate( material.anisotropy );
	}
	material.alphaT = mix( pow2( material.roughness ), 1.0, pow2( material.anisotropy ) );
	material.anisotropyT = tbn[ 0 ] * anisotropyV.x + tbn[ 1 ] * anisotropyV.y;
	material.anisotropyB = tbn[ 1 ] * anisotropyV.x - tbn[ 0 ] * anisotropyV.y;
#endif`,mE=`uniform sampler2D dfgLUT;
struct PhysicalMaterial {
	vec3 diffuseColor;
	vec3 diffuseContribution;
	vec3 specularColor;
	vec3 specularColorBlended;
	float roughness;
	float metalness;
	float specularF90;
	float dispersion;
	vec2 dfg;
	vec3 multiScatteringCompensation;
	#ifdef USE_DIFFUSE_ROUGHNESS
		float diffuseRoughness;
	#endif
	#ifdef USE_RETROREFLECTION
		float retroreflectivity;
	#endif
	#ifdef USE_CLEARCOAT
		float clearcoat;
		float clearcoatRoughness;
		vec3 clearcoatF0;
		float clearcoatF90;
	#endif
	#ifdef USE_IRIDESCENCE
		float iridescence;
		float iridescenceIOR;
		float iridescenceThickness;
		vec3 iridescenceFresnel;
		vec3 iridescenceF0Dielectric;
		vec3 iridescenceF0Metallic;
	#endif
	#ifdef USE_SHEEN
		vec3 sheenColor;
		float sheenRoughness;
	#endif
	#ifdef IOR
		float ior;
	#endif
	#ifdef USE_TRANSMISSION
		float transmission;
		float transmissionAlpha;
		float thickness;
		float attenuationDistance;
		vec3 attenuationColor;
	#endif
	#ifdef USE_ANISOTROPY
		float anisotropy;
		float alphaT;
		vec3 anisotropyT;
		vec3 anisotropyB;
	#endif
};
vec3 clearcoatSpecularDirect = vec3( 0.0 );
vec3 clearcoatSpecularIndirect = vec3( 0.0 );
vec3 sheenSpecularDirect = vec3( 0.0 );
vec3 sheenSpecularIndirect = vec3(0.0 );
vec3 Schlick_to_F0( const in vec3 f, const in float f90, const in float dotVH ) {
    float x = clamp( 1.0 - dotVH, 0.0, 1.0 );
    float x2 = x * x;
    float x5 = clamp( x * x2 * x2, 0.0, 0.9999 );
    return ( f - vec3( f90 ) * x5 ) / ( 1.0 - x5 );
}
#ifdef USE_DIFFUSE_ROUGHNESS
	const float EON_EPSILON = 1e-7;
	float FON_DirectionalAlbedo( const in float mu, const in float roughness, const in float A ) {
		float muComp = 1.0 - mu;
		float gOverPi = muComp * ( 0.0571085289 + muComp * ( 0.491881867 + muComp * ( - 0.332181442 + muComp * 0.0714429953 ) ) );
		return A * ( 1.0 + roughness * gOverPi );
	}
	vec3 BRDF_EON( const in vec3 lightDir, const in vec3 viewDir, const in vec3 normal, const in vec3 diffuseColor, const in float roughness ) {
		vec3 rho = saturate( diffuseColor );
		if ( roughness <= EON_EPSILON ) return BRDF_Lambert( rho );
		float dotNL = saturate( dot( normal, lightDir ) );
		float dotNV = saturate( dot( normal, viewDir ) );
		float s = dot( lightDir, viewDir ) - dotNL * dotNV;
		float sOverT = ( s > 0.0 ) ? s / max( max( dotNL, dotNV ), EON_EPSILON ) : s;
		float A = 1.0 / ( 1.0 + ( 0.5 - 2.0 / ( 3.0 * PI ) ) * roughness );
		vec3 singleScatter = rho * RECIPROCAL_PI * A * ( 1.0 + roughness * sOverT );
		float averageAlbedo = A * ( 1.0 + ( 2.0 / 3.0 - 28.0 / ( 15.0 * PI ) ) * roughness );
		float albedoV = FON_DirectionalAlbedo( dotNV, roughness, A );
		float albedoL = FON_DirectionalAlbedo( dotNL, roughness, A );
		vec3 rhoMultiScatter = rho * rho * averageAlbedo / max( vec3( EON_EPSILON ), vec3( 1.0 ) - rho * ( 1.0 - averageAlbedo ) );
		vec3 multiScatter = rhoMultiScatter * RECIPROCAL_PI
			* max( EON_EPSILON, 1.0 - albedoV )
			* max( EON_EPSILON, 1.0 - albedoL )
			/ max( EON_EPSILON, 1.0 - averageAlbedo );
		return singleScatter + multiScatter;
	}
	vec3 EON_DirectionalAlbedo( const in vec3 diffuseColor, const in float roughness, const in float dotNV ) {
		vec3 rho = saturate( diffuseColor );
		if ( roughness <= EON_EPSILON ) return rho;
		float A = 1.0 / ( 1.0 + ( 0.5 - 2.0 / ( 3.0 * PI ) ) * roughness );
		float directionalAlbedo = FON_DirectionalAlbedo( dotNV, roughness, A );
		float averageAlbedo = A * ( 1.0 + ( 2.0 / 3.0 - 28.0 / ( 15.0 * PI ) ) * roughness );
		vec3 rhoMultiScatter = rho * rho * averageAlbedo / max( vec3( EON_EPSILON ), vec3( 1.0 ) - rho * ( 1.0 - averageAlbedo ) );
		return rho * directionalAlbedo + rhoMultiScatter * ( 1.0 - directionalAlbedo );
	}
#endif
float V_GGX_SmithCorrelated( const in float alpha, const in float dotNL, const in float dotNV ) {
	float a2 = pow2( alpha );
	float gv = dotNL * sqrt( a2 + ( 1.0 - a2 ) * pow2( dotNV ) );
	float gl = dotNV * sqrt( a2 + ( 1.0 - a2 ) * pow2( dotNL ) );
	return 0.5 / max( gv + gl, EPSILON );
}
float D_GGX( const in float alpha, const in float dotNH ) {
	float a2 = pow2( alpha );
	float denom = pow2( dotNH ) * ( a2 - 1.0 ) + 1.0;
	return RECIPROCAL_PI * a2 / pow2( denom );
}
#ifdef USE_ANISOTROPY
	float V_GGX_SmithCorrelated_Anisotropic( const in float alphaT, const in float alphaB, const in float dotTV, const in float dotBV, const in float dotTL, const in float dotBL, const in float dotNV, const in float dotNL ) {
		float gv = dotNL * length( vec3( alphaT * dotTV, alphaB * dotBV, dotNV ) );
		float gl = dotNV * length( vec3( alphaT * dotTL, alphaB * dotBL, dotNL ) );
		return 0.5 / max( gv + gl, EPSILON );
	}
	float D_GGX_Anisotropic( const in float alphaT, const in float alphaB, const in float dotNH, const in float dotTH, const in float dotBH ) {
		float a2 = alphaT * alphaB;
		highp vec3 v = vec3( alphaB * dotTH, alphaT * dotBH, a2 * dotNH );
		highp float v2 = dot( v, v );
		float w2 = a2 / v2;
		return RECIPROCAL_PI * a2 * pow2 ( w2 );
	}
#endif
#ifdef USE_CLEARCOAT
	vec3 BRDF_GGX_Clearcoat( const in vec3 lightDir, const in vec3 viewDir, const in vec3 normal, const in PhysicalMaterial material) {
		vec3 f0 = material.clearcoatF0;
		float f90 = material.clearcoatF90;
		float roughness = max( material.clearcoatRoughness, 0.045 );
		float alpha = pow2( roughness );
		vec3 halfDir = normalize( lightDir + viewDir );
		float dotNL = saturate( dot( normal, lightDir ) );
		float dotNV = saturate( dot( normal, viewDir ) );
		float dotNH = saturate( dot( normal, halfDir ) );
		float dotVH = saturate( dot( viewDir, halfDir ) );
		vec3 F = F_Schlick( f0, f90, dotVH );
		float V = V_GGX_SmithCorrelated( alpha, dotNL, dotNV );
		float D = D_GGX( alpha, dotNH );
		return F * ( V * D );
	}
#endif
vec3 BRDF_GGX( const in vec3 lightDir, const in vec3 viewDir, const in vec3 normal, const in PhysicalMaterial material ) {
	vec3 f0 = material.specularColorBlended;
	float f90 = material.specularF90;
	float roughness = max( material.roughness, 0.045 );
	float alpha = pow2( roughness );
	vec3 halfDir = normalize( lightDir + viewDir );
	float dotNL = saturate( dot( normal, lightDir ) );
	float dotNV = saturate( dot( normal, viewDir ) );
	float dotNH = saturate( dot( normal, halfDir ) );
	float dotVH = saturate( dot( viewDir, halfDir ) );
	vec3 F = F_Schlick( f0, f90, dotVH );
	#ifdef USE_IRIDESCENCE
		F = mix( F, material.iridescenceFresnel, material.iridescence );
	#endif
	#ifdef USE_ANISOTROPY
		float dotTL = dot( material.anisotropyT, lightDir );
		float dotTV = dot( material.anisotropyT, viewDir );
		float dotTH = dot( material.anisotropyT, halfDir );
		float dotBL = dot( material.anisotropyB, lightDir );
		float dotBV = dot( material.anisotropyB, viewDir );
		float dotBH = dot( material.anisotropyB, halfDir );
		float alphaT = max( material.alphaT, alpha );
		float V = V_GGX_SmithCorrelated_Anisotropic( alphaT, alpha, dotTV, dotBV, dotTL, dotBL, dotNV, dotNL );
		float D = D_GGX_Anisotropic( alphaT, alpha, dotNH, dotTH, dotBH );
	#else
		float V = V_GGX_SmithCorrelated( alpha, dotNL, dotNV );
		float D = D_GGX( alpha, dotNH );
	#endif
	return F * ( V * D );
}
vec2 LTC_Uv( const in vec3 N, const in vec3 V, const in float roughness ) {
	const float LUT_SIZE = 64.0;
	const float LUT_SCALE = ( LUT_SIZE - 1.0 ) / LUT_SIZE;
	const float LUT_BIAS = 0.5 / LUT_SIZE;
	float dotNV = saturate( dot( N, V ) );
	vec2 uv = vec2( roughness, sqrt( 1.0 - dotNV ) );
	uv = uv * LUT_SCALE + LUT_BIAS;
	return uv;
}
float LTC_ClippedSphereFormFactor( const in vec3 f ) {
	float l = length( f );
	return max( ( l * l + f.z ) / ( l + 1.0 ), 0.0 );
}
vec3 LTC_EdgeVectorFormFactor( const in vec3 v1, const in vec3 v2 ) {
	float x = dot( v1, v2 );
	float y = abs( x );
	float a = 0.8543985 + ( 0.4965155 + 0.0145206 * y ) * y;
	float b = 3.4175940 + ( 4.1616724 + y ) * y;
	float v = a / b;
	float theta_sintheta = ( x > 0.0 ) ? v : 0.5 * inversesqrt( max( 1.0 - x * x, 1e-7 ) ) - v;
	return cross( v1, v2 ) * theta_sintheta;
}
vec3 LTC_Evaluate( const in vec3 N, const in vec3 V, const in vec3 P, const in mat3 mInv, const in vec3 rectCoords[ 4 ] ) {
	vec3 v1 = rectCoords[ 1 ] - rectCoords[ 0 ];
	vec3 v2 = rectCoords[ 3 ] - rectCoords[ 0 ];
	vec3 lightNormal = cross( v1, v2 );
	if( dot( lightNormal, P - rectCoords[ 0 ] ) < 0.0 ) return vec3( 0.0 );
	vec3 T1, T2;
	T1 = normalize( V - N * dot( V, N ) );
	T2 = - cross( N, T1 );
	mat3 mat = mInv * transpose( mat3( T1, T2, N ) );
	vec3 coords[ 4 ];
	coords[ 0 ] = mat * ( rectCoords[ 0 ] - P );
	coords[ 1 ] = mat * ( rectCoords[ 1 ] - P );
	coords[ 2 ] = mat * ( rectCoords[ 2 ] - P );
	coords[ 3 ] = mat * ( rectCoords[ 3 ] - P );
	coords[ 0 ] = normalize( coords[ 0 ] );
	coords[ 1 ] = normalize( coords[ 1 ] );
	coords[ 2 ] = normalize( coords[ 2 ] );
	coords[ 3 ] = normalize( coords[ 3 ] );
	vec3 vectorFormFactor = vec3( 0.0 );
	vectorFormFactor += LTC_EdgeVectorFormFactor( coords[ 0 ], coords[ 1 ] );
	vectorFormFactor += LTC_EdgeVectorFormFactor( coords[ 1 ], coords[ 2 ] );
	vectorFormFactor += LTC_EdgeVectorFormFactor( coords[ 2 ], coords[ 3 ] );
	vectorFormFactor += LTC_EdgeVectorFormFactor( coords[ 3 ], coords[ 0 ] );
	float result = LTC_ClippedSphereFormFactor( vectorFormFactor );
	return vec3( result );
}
#if defined( USE_SHEEN )
float D_Charlie( float roughness, float dotNH ) {
	float alpha = pow2( roughness );
	float invAlpha = 1.0 / alpha;
	float cos2h = dotNH * dotNH;
	float sin2h = max( 1.0 - cos2h, 0.0078125 );
	return ( 2.0 + invAlpha ) * pow( sin2h, invAlpha * 0.5 ) / ( 2.0 * PI );
}
float V_Neubelt( float dotNV, float dotNL ) {
	return saturate( 1.0 / ( 4.0 * ( dotNL + dotNV - dotNL * dotNV ) ) );
}
vec3 BRDF_Sheen( const in vec3 lightDir, const in vec3 viewDir, const in vec3 normal, vec3 sheenColor, const in float sheenRoughness ) {
	vec3 halfDir = normalize( lightDir + viewDir );
	float dotNL = saturate( dot( normal, lightDir ) );
	float dotNV = saturate( dot( normal, viewDir ) );
	float dotNH = saturate( dot( normal, halfDir ) );
	float D = D_Charlie( sheenRoughness, dotNH );
	float V = V_Neubelt( dotNV, dotNL );
	return sheenColor * ( D * V );
}
#endif
float IBLSheenBRDF( const in vec3 normal, const in vec3 viewDir, const in float roughness ) {
	float dotNV = saturate( dot( normal, viewDir ) );
	float r2 = roughness * roughness;
	float rInv = 1.0 / ( roughness + 0.1 );
	float a = -1.9362 + 1.0678 * roughness + 0.4573 * r2 - 0.8469 * rInv;
	float b = -0.6014 + 0.5538 * roughness - 0.4670 * r2 - 0.1255 * rInv;
	float DG = exp( a * dotNV + b );
	return saturate( DG );
}
vec3 EnvironmentBRDF( const in vec3 normal, const in vec3 viewDir, const in vec3 specularColor, const in float specularF90, const in float roughness ) {
	float dotNV = saturate( dot( normal, viewDir ) );
	vec2 fab = texture2D( dfgLUT, vec2( roughness, dotNV ) ).rg;
	return specularColor * fab.x + specularF90 * fab.y;
}
#ifdef USE_IRIDESCENCE
void computeMultiscatteringIridescence( const in vec2 fab, const in vec3 specularColor, const in float specularF90, const in float iridescence, const in vec3 iridescenceF0, inout vec3 singleScatter, inout vec3 multiScatter ) {
#else
void computeMultiscattering( const in vec2 fab, const in vec3 specularColor, const in float specularF90, inout vec3 singleScatter, inout vec3 multiScatter ) {
#endif
	#ifdef USE_IRIDESCENCE
		vec3 Fr = mix( specularColor, iridescenceF0, iridescence );
	#else
		vec3 Fr = specularColor;
	#endif
	vec3 FssEss = Fr * fab.x + specularF90 * fab.y;
	float Ess = fab.x + fab.y;
	float Ems = 1.0 - Ess;
	vec3 Favg = Fr + ( 1.0 - Fr ) * 0.047619;	vec3 Fms = FssEss * Favg / ( 1.0 - Ems * Favg );
	singleScatter += FssEss;
	multiScatter += Fms * Ems;
}
#if NUM_RECT_AREA_LIGHTS > 0
	void RE_Direct_RectArea_Physical( const in RectAreaLight rectAreaLight, const in vec3 geometryPosition, const in vec3 geometryNormal, const in vec3 geometryViewDir, const in vec3 geometryClearcoatNormal, const in PhysicalMaterial material, inout ReflectedLight reflectedLight ) {
		vec3 normal = geometryNormal;
		vec3 viewDir = geometryViewDir;
		vec3 position = geometryPosition;
		vec3 lightPos = rectAreaLight.position;
		vec3 halfWidth = rectAreaLight.halfWidth;
		vec3 halfHeight = rectAreaLight.halfHeight;
		vec3 lightColor = rectAreaLight.color;
		float roughness = material.roughness;
		vec3 rectCoords[ 4 ];
		rectCoords[ 0 ] = lightPos + halfWidth - halfHeight;		rectCoords[ 1 ] = lightPos - halfWidth - halfHeight;
		rectCoords[ 2 ] = lightPos - halfWidth + halfHeight;
		rectCoords[ 3 ] = lightPos + halfWidth + halfHeight;
		vec2 uv = LTC_Uv( normal, viewDir, roughness );
		vec4 t1 = texture2D( ltc_1, uv );
		vec4 t2 = texture2D( ltc_2, uv );
		mat3 mInv = mat3(
			vec3( t1.x, 0, t1.y ),
			vec3(    0, 1,    0 ),
			vec3( t1.z, 0, t1.w )
		);
		vec3 fresnel = ( material.specularColorBlended * t2.x + ( material.specularF90 - material.specularColorBlended ) * t2.y );
		reflectedLight.directSpecular += lightColor * fresnel * LTC_Evaluate( normal, viewDir, position, mInv, rectCoords );
		reflectedLight.directDiffuse += lightColor * material.diffuseContribution * LTC_Evaluate( normal, viewDir, position, mat3( 1.0 ), rectCoords );
		#ifdef USE_CLEARCOAT
			vec3 Ncc = geometryClearcoatNormal;
			vec2 uvClearcoat = LTC_Uv( Ncc, viewDir, material.clearcoatRoughness );
			vec4 t1Clearcoat = texture2D( ltc_1, uvClearcoat );
			vec4 t2Clearcoat = texture2D( ltc_2, uvClearcoat );
			mat3 mInvClearcoat = mat3(
				vec3( t1Clearcoat.x, 0, t1Clearcoat.y ),
				vec3(             0, 1,             0 ),
				vec3( t1Clearcoat.z, 0, t1Clearcoat.w )
			);
			vec3 fresnelClearcoat = material.clearcoatF0 * t2Clearcoat.x + ( material.clearcoatF90 - material.clearcoatF0 ) * t2Clearcoat.y;
			clearcoatSpecularDirect += lightColor * fresnelClearcoat * LTC_Evaluate( Ncc, viewDir, position, mInvClearcoat, rectCoords );
		#endif
	}
#endif
void RE_Direct_Physical( const in IncidentLight directLight, const in vec3 geometryPosition, const in vec3 geometryNormal, const in vec3 geometryViewDir, const in vec3 geometryClearcoatNormal, const in PhysicalMaterial material, inout ReflectedLight reflectedLight ) {
	float dotNL = saturate( dot( geometryNormal, directLight.direction ) );
	vec3 irradiance = dotNL * directLight.color;
	#ifdef USE_CLEARCOAT
		float dotNLcc = saturate( dot( geometryClearcoatNormal, directLight.direction ) );
		vec3 ccIrradiance = dotNLcc * directLight.color;
		clearcoatSpecularDirect += ccIrradiance * BRDF_GGX_Clearcoat( directLight.direction, geometryViewDir, geometryClearcoatNormal, material );
	#endif
	#ifdef USE_SHEEN
 
 		sheenSpecularDirect += irradiance * BRDF_Sheen( directLight.direction, geometryViewDir, geometryNormal, material.sheenColor, material.sheenRoughness );
 
 		float sheenAlbedoV = IBLSheenBRDF( geometryNormal, geometryViewDir, material.sheenRoughness );
 		float sheenAlbedoL = IBLSheenBRDF( geometryNormal, directLight.direction, material.sheenRoughness );
 
 		float sheenEnergyComp = 1.0 - max3( material.sheenColor ) * max( sheenAlbedoV, sheenAlbedoL );
 
 		irradiance *= sheenEnergyComp;
 
 	#endif
	vec3 specularBRDF = BRDF_GGX( directLight.direction, geometryViewDir, geometryNormal, material );
	#ifdef USE_RETROREFLECTION
		vec3 retroViewDir = reflect( - geometryViewDir, geometryNormal );
		vec3 retroSpecularBRDF = BRDF_GGX( directLight.direction, retroViewDir, geometryNormal, material );
		specularBRDF = mix( specularBRDF, retroSpecularBRDF, saturate( material.retroreflectivity ) );
	#endif
	reflectedLight.directSpecular += irradiance * specularBRDF * material.multiScatteringCompensation;
	vec3 halfDir = normalize( directLight.direction + geometryViewDir );
	float dotVH = saturate( dot( geometryViewDir, halfDir ) );
	vec3 F = F_Schlick( material.specularColor, material.specularF90, dotVH );
	#ifdef USE_RETROREFLECTION
		vec3 retroHalfDir = normalize( directLight.direction + retroViewDir );
		float dotRetroVH = saturate( dot( retroViewDir, retroHalfDir ) );
		vec3 retroF = F_Schlick( material.specularColor, material.specularF90, dotRetroVH );
		F = mix( F, retroF, saturate( material.retroreflectivity ) );
	#endif
	#ifdef USE_DIFFUSE_ROUGHNESS
		vec3 diffuseBRDF = BRDF_EON( directLight.direction, geometryViewDir, geometryNormal, material.diffuseColor, material.diffuseRoughness ) * ( 1.0 - material.metalness );
	#else
		vec3 diffuseBRDF = BRDF_Lambert( material.diffuseContribution );
	#endif
	reflectedLight.directDiffuse += irradiance * diffuseBRDF * ( 1.0 - F );
}
void RE_IndirectDiffuse_Physical( const in vec3 irradiance, const in vec3 geometryPosition, const in vec3 geometryNormal, const in vec3 geometryViewDir, const in vec3 geometryClearcoatNormal, const in PhysicalMaterial material, inout ReflectedLight reflectedLight ) {
	vec3 singleScattering = vec3( 0.0 );
	vec3 multiScattering = vec3( 0.0 );
	#ifdef USE_IRIDESCENCE
		computeMultiscatteringIridescence( material.dfg, material.specularColor, material.specularF90, material.iridescence, material.iridescenceF0Dielectric, singleScattering, multiScattering );
	#else
		computeMultiscattering( material.dfg, material.specularColor, material.specularF90, singleScattering, multiScattering );
	#endif
	#ifdef USE_DIFFUSE_ROUGHNESS
		float dotNV = saturate( dot( geometryNormal, geometryViewDir ) );
		vec3 diffuseAlbedo = EON_DirectionalAlbedo( material.diffuseColor, material.diffuseRoughness, dotNV ) * ( 1.0 - material.metalness );
		vec3 diffuse = irradiance * RECIPROCAL_PI * diffuseAlbedo * ( 1.0 - singleScattering - multiScattering );
	#else
		vec3 diffuse = irradiance * BRDF_Lambert( material.diffuseContribution ) * ( 1.0 - singleScattering - multiScattering );
	#endif
	#ifdef USE_SHEEN
		float sheenAlbedo = IBLSheenBRDF( geometryNormal, geometryViewDir, material.sheenRoughness );
		sheenSpecularIndirect += irradiance * material.sheenColor * sheenAlbedo * RECIPROCAL_PI;
		float sheenEnergyComp = 1.0 - max3( material.sheenColor ) * sheenAlbedo;
		diffuse *= sheenEnergyComp;
	#endif
	reflectedLight.indirectDiffuse += diffuse;
}
void RE_IndirectSpecular_Physical( const in vec3 radiance, const in vec3 irradiance, const in vec3 clearcoatRadiance, const in vec3 geometryPosition, const in vec3 geometryNormal, const in vec3 geometryViewDir, const in vec3 geometryClearcoatNormal, const in PhysicalMaterial material, inout ReflectedLight reflectedLight) {
	#ifdef USE_CLEARCOAT
		clearcoatSpecularIndirect += clearcoatRadiance * EnvironmentBRDF( geometryClearcoatNormal, geometryViewDir, material.clearcoatF0, material.clearcoatF90, material.clearcoatRoughness );
	#endif
	#ifdef USE_SHEEN
		sheenSpecularIndirect += irradiance * material.sheenColor * IBLSheenBRDF( geometryNormal, geometryViewDir, material.sheenRoughness ) * RECIPROCAL_PI;
 	#endif
	vec3 singleScatteringDielectric = vec3( 0.0 );
	vec3 multiScatteringDielectric = vec3( 0.0 );
	vec3 singleScatteringMetallic = vec3( 0.0 );
	vec3 multiScatteringMetallic = vec3( 0.0 );
	#ifdef USE_IRIDESCENCE
		computeMultiscatteringIridescence( material.dfg, material.specularColor, material.specularF90, material.iridescence, material.iridescenceF0Dielectric, singleScatteringDielectric, multiScatteringDielectric );
		computeMultiscatteringIridescence( material.dfg, material.diffuseColor, material.specularF90, material.iridescence, material.iridescenceF0Metallic, singleScatteringMetallic, multiScatteringMetallic );
	#else
		computeMultiscattering( material.dfg, material.specularColor, material.specularF90, singleScatteringDielectric, multiScatteringDielectric );
		computeMultiscattering( material.dfg, material.diffuseColor, material.specularF90, singleScatteringMetallic, multiScatteringMetallic );
	#endif
	vec3 singleScattering = mix( singleScatteringDielectric, singleScatteringMetallic, material.metalness );
	vec3 multiScattering = mix( multiScatteringDielectric, multiScatteringMetallic, material.metalness );
	vec3 totalScatteringDielectric = singleScatteringDielectric + multiScatteringDielectric;
	#ifdef USE_DIFFUSE_ROUGHNESS
		float dotNV = saturate( dot( geometryNormal, geometryViewDir ) );
		vec3 diffuse = EON_DirectionalAlbedo( material.diffuseColor, material.diffuseRoughness, dotNV ) * ( 1.0 - material.metalness ) * ( 1.0 - totalScatteringDielectric );
	#else
		vec3 diffuse = material.diffuseContribution * ( 1.0 - totalScatteringDielectric );
	#endif
	vec3 cosineWeightedIrradiance = irradiance * RECIPROCAL_PI;
	vec3 indirectSpecular = radiance * singleScattering;
	indirectSpecular += multiScattering * cosineWeightedIrradiance;
	vec3 indirectDiffuse = diffuse * cosineWeightedIrradiance;
	#ifdef USE_SHEEN
		float sheenAlbedo = IBLSheenBRDF( geometryNormal, geometryViewDir, material.sheenRoughness );
		float sheenEnergyComp = 1.0 - max3( material.sheenColor ) * sheenAlbedo;
		indirectSpecular *= sheenEnergyComp;
		indirectDiffuse *= sheenEnergyComp;
	#endif
	reflectedLight.indirectSpecular += indirectSpecular;
	reflectedLight.indirectDiffuse += indirectDiffuse;
}
#define RE_Direct				RE_Direct_Physical
#define RE_Direct_RectArea		RE_Direct_RectArea_Physical
#define RE_IndirectDiffuse		RE_IndirectDiffuse_Physical
#define RE_IndirectSpecular		RE_IndirectSpecular_Physical
float computeSpecularOcclusion( const in float dotNV, const in float ambientOcclusion, const in float roughness ) {
	return saturate( pow( dotNV + ambientOcclusion, exp2( - 16.0 * roughness - 1.0 ) ) - 1.0 + ambientOcclusion );
}`,gE=`
vec3 geometryPosition = - vViewPosition;
vec3 geometryNormal = normal;
vec3 geometryViewDir = ( isOrthographic ) ? vec3( 0, 0, 1 ) : normalize( vViewPosition );
vec3 geometryClearcoatNormal = vec3( 0.0 );
#ifdef USE_CLEARCOAT
	geometryClearcoatNormal = clearcoatNormal;
#endif
#ifdef USE_IRIDESCENCE
	float dotNVi = saturate( dot( normal, geometryViewDir ) );
	if ( material.iridescenceThickness == 0.0 ) {
		material.iridescence = 0.0;
	} else {
		material.iridescence = saturate( material.iridescence );
	}
	if ( material.iridescence > 0.0 ) {
		vec3 iridescenceFresnelDielectric = evalIridescence( 1.0, material.iridescenceIOR, dotNVi, material.iridescenceThickness, material.specularColor );
		vec3 iridescenceFresnelMetallic = evalIridescence( 1.0, material.iridescenceIOR, dotNVi, material.iridescenceThickness, material.diffuseColor );
		material.iridescenceFresnel = mix( iridescenceFresnelDielectric, iridescenceFresnelMetallic, material.metalness );
		material.iridescenceF0Dielectric = Schlick_to_F0( iridescenceFresnelDielectric, 1.0, dotNVi );
		material.iridescenceF0Metallic = Schlick_to_F0( iridescenceFresnelMetallic, 1.0, dotNVi );
	}
#endif
#ifdef STANDARD
	float dotNVms = saturate( dot( geometryNormal, geometryViewDir ) );
	material.dfg = texture2D( dfgLUT, vec2( material.roughness, dotNVms ) ).rg;
	#if ( NUM_SUN_LIGHTS > 0 || NUM_DIR_LIGHTS > 0 || NUM_POINT_LIGHTS > 0 || NUM_SPOT_LIGHTS > 0 )
		float EssMs = material.dfg.x + material.dfg.y;
		material.multiScatteringCompensation = 1.0 + material.specularColorBlended * ( 1.0 / EssMs - 1.0 );
	#endif
#endif
IncidentLight directLight;
#if ( NUM_POINT_LIGHTS > 0 ) && defined( RE_Direct )
	PointLight pointLight;
	#if defined( USE_SHADOWMAP ) && NUM_POINT_LIGHT_SHADOWS > 0
	PointLightShadow pointLightShadow;
	#endif
	#pragma unroll_loop_start
	for ( int i = 0; i < NUM_POINT_LIGHTS; i ++ ) {
		pointLight = pointLights[ i ];
		getPointLightInfo( pointLight, geometryPosition, directLight );
		#if defined( USE_SHADOWMAP ) && ( UNROLLED_LOOP_INDEX < NUM_POINT_LIGHT_SHADOWS ) && ( defined( SHADOWMAP_TYPE_PCF ) || defined( SHADOWMAP_TYPE_BASIC ) )
		pointLightShadow = pointLightShadows[ i ];
		directLight.color *= ( directLight.visible && receiveShadow ) ? getPointShadow( pointShadowMap[ i ], pointLightShadow.shadowMapSize, pointLightShadow.shadowIntensity, pointLightShadow.shadowBias, pointLightShadow.shadowRadius, vPointShadowCoord[ i ], pointLightShadow.shadowCameraNear, pointLightShadow.shadowCameraFar ) : 1.0;
		#endif
		RE_Direct( directLight, geometryPosition, geometryNormal, geometryViewDir, geometryClearcoatNormal, material, reflectedLight );
	}
	#pragma unroll_loop_end
#endif
#if ( NUM_SPOT_LIGHTS > 0 ) && defined( RE_Direct )
	SpotLight spotLight;
	vec4 spotColor;
	vec3 spotLightCoord;
	bool inSpotLightMap;
	#if defined( USE_SHADOWMAP ) && NUM_SPOT_LIGHT_SHADOWS > 0
	SpotLightShadow spotLightShadow;
	#endif
	#pragma unroll_loop_start
	for ( int i = 0; i < NUM_SPOT_LIGHTS; i ++ ) {
		spotLight = spotLights[ i ];
		getSpotLightInfo( spotLight, geometryPosition, directLight );
		#if ( UNROLLED_LOOP_INDEX < NUM_SPOT_LIGHT_SHADOWS_WITH_MAPS )
		#define SPOT_LIGHT_MAP_INDEX UNROLLED_LOOP_INDEX
		#elif ( UNROLLED_LOOP_INDEX < NUM_SPOT_LIGHT_SHADOWS )
		#define SPOT_LIGHT_MAP_INDEX NUM_SPOT_LIGHT_MAPS
		#else
		#define SPOT_LIGHT_MAP_INDEX ( UNROLLED_LOOP_INDEX - NUM_SPOT_LIGHT_SHADOWS + NUM_SPOT_LIGHT_SHADOWS_WITH_MAPS )
		#endif
		#if ( SPOT_LIGHT_MAP_INDEX < NUM_SPOT_LIGHT_MAPS )
			spotLightCoord = vSpotLightCoord[ i ].xyz / vSpotLightCoord[ i ].w;
			inSpotLightMap = all( lessThan( abs( spotLightCoord * 2. - 1. ), vec3( 1.0 ) ) );
			spotColor = texture2D( spotLightMap[ SPOT_LIGHT_MAP_INDEX ], spotLightCoord.xy );
			directLight.color = inSpotLightMap ? directLight.color * spotColor.rgb : directLight.color;
		#endif
		#undef SPOT_LIGHT_MAP_INDEX
		#if defined( USE_SHADOWMAP ) && ( UNROLLED_LOOP_INDEX < NUM_SPOT_LIGHT_SHADOWS )
		spotLightShadow = spotLightShadows[ i ];
		directLight.color *= ( directLight.visible && receiveShadow ) ? getShadow( spotShadowMap[ i ], spotLightShadow.shadowMapSize, spotLightShadow.shadowIntensity, spotLightShadow.shadowBias, spotLightShadow.shadowRadius, vSpotLightCoord[ i ] ) : 1.0;
		#endif
		RE_Direct( directLight, geometryPosition, geometryNormal, geometryViewDir, geometryClearcoatNormal, material, reflectedLight );
	}
	#pragma unroll_loop_end
#endif
#if ( NUM_SUN_LIGHTS > 0 ) && defined( RE_Direct )
	SunLight sunLight;
	#if defined( USE_SHADOWMAP ) && NUM_SUN_LIGHT_SHADOWS > 0
	SunLightShadow sunLightShadow;
	#endif
	#pragma unroll_loop_start
	for ( int i = 0; i < NUM_SUN_LIGHTS; i ++ ) {
		sunLight = sunLights[ i ];
		getSunLightInfo( sunLight, directLight );
		#if defined( USE_SHADOWMAP ) && ( UNROLLED_LOOP_INDEX < NUM_SUN_LIGHT_SHADOWS )
		sunLightShadow = sunLightShadows[ i ];
		directLight.color *= ( directLight.visible && receiveShadow ) ? getSunShadow( sunShadowMap[ i ], sunLightShadow, UNROLLED_LOOP_INDEX ) : 1.0;
		#endif
		RE_Direct( directLight, geometryPosition, geometryNormal, geometryViewDir, geometryClearcoatNormal, material, reflectedLight );
	}
	#pragma unroll_loop_end
#endif
#if ( NUM_DIR_LIGHTS > 0 ) && defined( RE_Direct )
	DirectionalLight directionalLight;
	#if defined( USE_SHADOWMAP ) && NUM_DIR_LIGHT_SHADOWS > 0
	DirectionalLightShadow directionalLightShadow;
	#endif
	#pragma unroll_loop_start
	for ( int i = 0; i < NUM_DIR_LIGHTS; i ++ ) {
		directionalLight = directionalLights[ i ];
		getDirectionalLightInfo( directionalLight, directLight );
		#if defined( USE_SHADOWMAP ) && ( UNROLLED_LOOP_INDEX < NUM_DIR_LIGHT_SHADOWS )
		directionalLightShadow = directionalLightShadows[ i ];
		directLight.color *= ( directLight.visible && receiveShadow ) ? getShadow( directionalShadowMap[ i ], directionalLightShadow.shadowMapSize, directionalLightShadow.shadowIntensity, directionalLightShadow.shadowBias, directionalLightShadow.shadowRadius, vDirectionalShadowCoord[ i ] ) : 1.0;
		#endif
		RE_Direct( directLight, geometryPosition, geometryNormal, geometryViewDir, geometryClearcoatNormal, material, reflectedLight );
	}
	#pragma unroll_loop_end
#endif
#if ( NUM_RECT_AREA_LIGHTS > 0 ) && defined( RE_Direct_RectArea )
	RectAreaLight rectAreaLight;
	#pragma unroll_loop_start
	for ( int i = 0; i < NUM_RECT_AREA_LIGHTS; i ++ ) {
		rectAreaLight = rectAreaLights[ i ];
		RE_Direct_RectArea( rectAreaLight, geometryPosition, geometryNormal, geometryViewDir, geometryClearcoatNormal, material, reflectedLight );
	}
	#pragma unroll_loop_end
#endif
#if defined( RE_IndirectDiffuse )
	vec3 iblIrradiance = vec3( 0.0 );
	vec3 irradiance = getAmbientLightIrradiance( ambientLightColor );
	#if defined( USE_LIGHT_PROBES )
		irradiance += getLightProbeIrradiance( lightProbe, geometryNormal );
	#endif
	#if ( NUM_HEMI_LIGHTS > 0 )
		#pragma unroll_loop_start
		for ( int i = 0; i < NUM_HEMI_LIGHTS; i ++ ) {
			irradiance += getHemisphereLightIrradiance( hemisphereLights[ i ], geometryNormal );
		}
		#pragma unroll_loop_end
	#endif
	#if NUM_LIGHT_PROBE_GRIDS > 0
		vec3 probeWorldPos = ( ( vec4( geometryPosition, 1.0 ) - viewMatrix[ 3 ] ) * viewMatrix ).xyz;
		vec3 probeWorldNormal = transformNormalByInverseViewMatrix( geometryNormal, viewMatrix );
		int probeGrid = - 1;
		#pragma unroll_loop_start
		for ( int i = 0; i < NUM_LIGHT_PROBE_GRIDS; i ++ ) {
			if ( isInsideLightProbeGrid( probeWorldPos, probeWorldNormal, probesMin[ i ], probesMax[ i ], probesResolution[ i ] ) ) probeGrid = UNROLLED_LOOP_INDEX;
		}
		#pragma unroll_loop_end
		#pragma unroll_loop_start
		for ( int i = 0; i < NUM_LIGHT_PROBE_GRIDS; i ++ ) {
			if ( probeGrid == UNROLLED_LOOP_INDEX ) irradiance += getLightProbeGridIrradiance( probesSH[ i ], probesMin[ i ], probesMax[ i ], probesResolution[ i ], probeWorldPos, probeWorldNormal );
		}
		#pragma unroll_loop_end
	#endif
#endif
#if defined( RE_IndirectSpecular )
	vec3 radiance = vec3( 0.0 );
	vec3 clearcoatRadiance = vec3( 0.0 );
#endif`,yE=`#if defined( RE_IndirectDiffuse )
	#ifdef USE_LIGHTMAP
		vec4 lightMapTexel = texture2D( lightMap, vLightMapUv );
		vec3 lightMapIrradiance = lightMapTexel.rgb * lightMapIntensity;
		irradiance += lightMapIrradiance;
	#endif
	#if defined( USE_ENVMAP ) && defined( ENVMAP_TYPE_PMREM )
		#if defined( STANDARD ) || defined( LAMBERT ) || defined( PHONG )
			iblIrradiance += getIBLIrradiance( geometryNormal );
		#endif
	#endif
#endif
#if defined( USE_ENVMAP ) && defined( RE_IndirectSpecular )
	#ifdef USE_ANISOTROPY
		vec3 iblRadiance = getIBLAnisotropyRadiance( geometryViewDir, geometryNormal, material.roughness, material.anisotropyB, material.anisotropy );
	#else
		vec3 iblRadiance = getIBLRadiance( geometryViewDir, geometryNormal, material.roughness );
	#endif
	#ifdef USE_RETROREFLECTION
		#ifdef USE_ANISOTROPY
			vec3 retroIBLRadiance = getIBLAnisotropyRetroRadiance( geometryViewDir, geometryNormal, material.roughness, material.anisotropyB, material.anisotropy );
		#else
			vec3 retroIBLRadiance = getIBLRetroRadiance( geometryViewDir, geometryNormal, material.roughness );
		#endif
		iblRadiance = mix( iblRadiance, retroIBLRadiance, saturate( material.retroreflectivity ) );
	#endif
	radiance += iblRadiance;
	#ifdef USE_CLEARCOAT
		clearcoatRadiance += getIBLRadiance( geometryViewDir, geometryClearcoatNormal, material.clearcoatRoughness );
	#endif
#endif`,_E=`#if defined( RE_IndirectDiffuse )
	#if defined( LAMBERT ) || defined( PHONG )
		irradiance += iblIrradiance;
	#endif
	RE_IndirectDiffuse( irradiance, geometryPosition, geometryNormal, geometryViewDir, geometryClearcoatNormal, material, reflectedLight );
#endif
#if defined( RE_IndirectSpecular )
	RE_IndirectSpecular( radiance, iblIrradiance, clearcoatRadiance, geometryPosition, geometryNormal, geometryViewDir, geometryClearcoatNormal, material, reflectedLight );
#endif`,xE=`#if NUM_LIGHT_PROBE_GRIDS > 0
uniform highp sampler3D probesSH[ NUM_LIGHT_PROBE_GRIDS ];
uniform vec3 probesMin[ NUM_LIGHT_PROBE_GRIDS ];
uniform vec3 probesMax[ NUM_LIGHT_PROBE_GRIDS ];
uniform vec3 probesResolution[ NUM_LIGHT_PROBE_GRIDS ];
bool isInsideLightProbeGrid( vec3 worldPos, vec3 worldNormal, vec3 probesMin, vec3 probesMax, vec3 probesResolution ) {
	vec3 spacing = ( probesMax - probesMin ) / probesResolution;
	vec3 samplePos = worldPos + worldNormal * spacing * 0.5;
	vec3 margin = spacing * 0.01;
	return all( greaterThanEqual( samplePos, probesMin - margin ) ) && all( lessThanEqual( samplePos, probesMax + margin ) );
}
vec3 getLightProbeGridIrradiance( highp sampler3D probesSH, vec3 probesMin, vec3 probesMax, vec3 probesResolution, vec3 worldPos, vec3 worldNormal ) {
	vec3 res = probesResolution;
	vec3 gridRange = probesMax - probesMin;
	vec3 probeSpacing = gridRange / res;
	vec3 samplePos = worldPos + worldNormal * probeSpacing * 0.5;
	vec3 uvw = clamp( ( samplePos - probesMin ) / gridRange, 0.5 / res, 1.0 - 0.5 / res );
	float nz          = res.z;
	float paddedSlices = nz + 2.0;
	float atlasDepth  = 7.0 * paddedSlices;
	float uvZBase     = uvw.z * nz + 1.0;
	vec4 s0 = texture( probesSH, vec3( uvw.xy, ( uvZBase                       ) / atlasDepth ) );
	vec4 s1 = texture( probesSH, vec3( uvw.xy, ( uvZBase +       paddedSlices   ) / atlasDepth ) );
	vec4 s2 = texture( probesSH, vec3( uvw.xy, ( uvZBase + 2.0 * paddedSlices   ) / atlasDepth ) );
	vec4 s3 = texture( probesSH, vec3( uvw.xy, ( uvZBase + 3.0 * paddedSlices   ) / atlasDepth ) );
	vec4 s4 = texture( probesSH, vec3( uvw.xy, ( uvZBase + 4.0 * paddedSlices   ) / atlasDepth ) );
	vec4 s5 = texture( probesSH, vec3( uvw.xy, ( uvZBase + 5.0 * paddedSlices   ) / atlasDepth ) );
	vec4 s6 = texture( probesSH, vec3( uvw.xy, ( uvZBase + 6.0 * paddedSlices   ) / atlasDepth ) );
	vec3 c0 = s0.xyz;
	vec3 c1 = vec3( s0.w, s1.xy );
	vec3 c2 = vec3( s1.zw, s2.x );
	vec3 c3 = s2.yzw;
	vec3 c4 = s3.xyz;
	vec3 c5 = vec3( s3.w, s4.xy );
	vec3 c6 = vec3( s4.zw, s5.x );
	vec3 c7 = s5.yzw;
	vec3 c8 = s6.xyz;
	float x = worldNormal.x, y = worldNormal.y, z = worldNormal.z;
	vec3 result = c0 * 0.886227;
	result += c1 * 2.0 * 0.511664 * y;
	result += c2 * 2.0 * 0.511664 * z;
	result += c3 * 2.0 * 0.511664 * x;
	result += c4 * 2.0 * 0.429043 * x * y;
	result += c5 * 2.0 * 0.429043 * y * z;
	result += c6 * ( 0.743125 * z * z - 0.247708 );
	result += c7 * 2.0 * 0.429043 * x * z;
	result += c8 * 0.429043 * ( x * x - y * y );
	return max( result, vec3( 0.0 ) );
}
#endif`,vE=`#if defined( USE_LOGARITHMIC_DEPTH_BUFFER )
	gl_FragDepth = vIsPerspective == 0.0 ? gl_FragCoord.z : log2( vFragDepth ) * logDepthBufFC * 0.5;
#endif`,bE=`#if defined( USE_LOGARITHMIC_DEPTH_BUFFER )
	uniform float logDepthBufFC;
	varying float vFragDepth;
	varying float vIsPerspective;
#endif`,SE=`#ifdef USE_LOGARITHMIC_DEPTH_BUFFER
	varying float vFragDepth;
	varying float vIsPerspective;
#endif`,ME=`#ifdef USE_LOGARITHMIC_DEPTH_BUFFER
	vFragDepth = 1.0 + gl_Position.w;
	vIsPerspective = float( isPerspectiveMatrix( projectionMatrix ) );
#endif`,wE=`#ifdef USE_MAP
	vec4 sampledDiffuseColor = texture2D( map, vMapUv );
	#ifdef DECODE_VIDEO_TEXTURE
		sampledDiffuseColor = sRGBTransferEOTF( sampledDiffuseColor );
	#endif
	diffuseColor *= sampledDiffuseColor;
#endif`,TE=`#ifdef USE_MAP
	uniform sampler2D map;
#endif`,AE=`#if defined( USE_MAP ) || defined( USE_ALPHAMAP )
	#if defined( USE_POINTS_UV )
		vec2 uv = vUv;
	#else
		vec2 uv = ( uvTransform * vec3( gl_PointCoord.x, 1.0 - gl_PointCoord.y, 1 ) ).xy;
	#endif
#endif
#ifdef USE_MAP
	diffuseColor *= texture2D( map, uv );
#endif
#ifdef USE_ALPHAMAP
	diffuseColor.a *= texture2D( alphaMap, uv ).g;
#endif`,EE=`#if defined( USE_POINTS_UV )
	varying vec2 vUv;
#else
	#if defined( USE_MAP ) || defined( USE_ALPHAMAP )
		uniform mat3 uvTransform;
	#endif
#endif
#ifdef USE_MAP
	uniform sampler2D map;
#endif
#ifdef USE_ALPHAMAP
	uniform sampler2D alphaMap;
#endif`,CE=`float metalnessFactor = metalness;
#ifdef USE_METALNESSMAP
	vec4 texelMetalness = texture2D( metalnessMap, vMetalnessMapUv );
	metalnessFactor *= texelMetalness.b;
#endif`,RE=`#ifdef USE_METALNESSMAP
	uniform sampler2D metalnessMap;
#endif`,PE=`#ifdef USE_INSTANCING_MORPH
	float morphTargetInfluences[ MORPHTARGETS_COUNT ];
	float morphTargetBaseInfluence = texelFetch( morphTexture, ivec2( 0, gl_InstanceID ), 0 ).r;
	for ( int i = 0; i < MORPHTARGETS_COUNT; i ++ ) {
		morphTargetInfluences[i] =  texelFetch( morphTexture, ivec2( i + 1, gl_InstanceID ), 0 ).r;
	}
#endif`,LE=`#if defined( USE_MORPHCOLORS )
	#if defined( USE_COLOR_ALPHA )
		vColor *= morphTargetBaseInfluence;
	#elif defined( USE_COLOR )
		vColor.rgb *= morphTargetBaseInfluence;
	#endif
	for ( int i = 0; i < MORPHTARGETS_COUNT; i ++ ) {
		#if defined( USE_COLOR_ALPHA )
			if ( morphTargetInfluences[ i ] != 0.0 ) vColor += getMorph( gl_VertexID, i, 2 ) * morphTargetInfluences[ i ];
		#elif defined( USE_COLOR )
			if ( morphTargetInfluences[ i ] != 0.0 ) vColor.rgb += getMorph( gl_VertexID, i, 2 ).rgb * morphTargetInfluences[ i ];
		#endif
	}
#endif`,IE=`#ifdef USE_MORPHNORMALS
	objectNormal *= morphTargetBaseInfluence;
	for ( int i = 0; i < MORPHTARGETS_COUNT; i ++ ) {
		if ( morphTargetInfluences[ i ] != 0.0 ) objectNormal += getMorph( gl_VertexID, i, 1 ).xyz * morphTargetInfluences[ i ];
	}
#endif`,NE=`#ifdef USE_MORPHTARGETS
	#ifndef USE_INSTANCING_MORPH
		uniform float morphTargetBaseInfluence;
		uniform float morphTargetInfluences[ MORPHTARGETS_COUNT ];
	#endif
	uniform sampler2DArray morphTargetsTexture;
	uniform ivec2 morphTargetsTextureSize;
	vec4 getMorph( const in int vertexIndex, const in int morphTargetIndex, const in int offset ) {
		int texelIndex = vertexIndex * MORPHTARGETS_TEXTURE_STRIDE + offset;
		int y = texelIndex / morphTargetsTextureSize.x;
		int x = texelIndex - y * morphTargetsTextureSize.x;
		ivec3 morphUV = ivec3( x, y, morphTargetIndex );
		return texelFetch( morphTargetsTexture, morphUV, 0 );
	}
#endif`,DE=`#ifdef USE_MORPHTARGETS
	transformed *= morphTargetBaseInfluence;
	for ( int i = 0; i < MORPHTARGETS_COUNT; i ++ ) {
		if ( morphTargetInfluences[ i ] != 0.0 ) transformed += getMorph( gl_VertexID, i, 0 ).xyz * morphTargetInfluences[ i ];
	}
#endif`,OE=`float faceDirection = gl_FrontFacing ? 1.0 : - 1.0;
#ifdef FLAT_SHADED
	vec3 fdx = dFdx( vViewPosition );
	vec3 fdy = dFdy( vViewPosition );
	vec3 normal = normalize( cross( fdx, fdy ) );
#else
	vec3 normal = normalize( vNormal );
	#ifdef DOUBLE_SIDED
		normal *= faceDirection;
	#endif
#endif
#if defined( USE_NORMALMAP_TANGENTSPACE ) || defined( USE_CLEARCOAT_NORMALMAP ) || defined( USE_ANISOTROPY )
	#ifdef USE_TANGENT
		mat3 tbn = mat3( normalize( vTangent ), normalize( vBitangent ), normal );
	#else
		mat3 tbn = getTangentFrame( - vViewPosition, normal,
		#if defined( USE_NORMALMAP )
			vNormalMapUv
		#elif defined( USE_CLEARCOAT_NORMALMAP )
			vClearcoatNormalMapUv
		#else
			vUv
		#endif
		);
	#endif
	#ifdef DOUBLE_SIDED
		tbn[0] *= faceDirection;
		tbn[1] *= faceDirection;
	#endif
#endif
#ifdef USE_CLEARCOAT_NORMALMAP
	#ifdef USE_TANGENT
		mat3 tbn2 = mat3( normalize( vTangent ), normalize( vBitangent ), normal );
	#else
		mat3 tbn2 = getTangentFrame( - vViewPosition, normal, vClearcoatNormalMapUv );
	#endif
	#ifdef DOUBLE_SIDED
		tbn2[0] *= faceDirection;
		tbn2[1] *= faceDirection;
	#endif
#endif
vec3 nonPerturbedNormal = normal;`,FE=`#ifdef USE_NORMALMAP_OBJECTSPACE
	normal = texture2D( normalMap, vNormalMapUv ).xyz * 2.0 - 1.0;
	#ifdef FLIP_SIDED
		normal = - normal;
	#endif
	#ifdef DOUBLE_SIDED
		normal = normal * faceDirection;
	#endif
	normal = normalize( normalMatrix * normal );
#elif defined( USE_NORMALMAP_TANGENTSPACE )
	vec3 mapN = texture2D( normalMap, vNormalMapUv ).xyz * 2.0 - 1.0;
	#if defined( USE_PACKED_NORMALMAP )
		mapN = vec3( mapN.xy, sqrt( saturate( 1.0 - dot( mapN.xy, mapN.xy ) ) ) );
	#endif
	mapN.xy *= normalScale;
	normal = normalize( tbn * mapN );
#elif defined( USE_BUMPMAP )
	normal = perturbNormalArb( - vViewPosition, normal, dHdxy_fwd(), faceDirection );
#endif`,UE=`#ifndef FLAT_SHADED
	varying vec3 vNormal;
	#ifdef USE_TANGENT
		varying vec3 vTangent;
		varying vec3 vBitangent;
	#endif
#endif`,BE=`#ifndef FLAT_SHADED
	varying vec3 vNormal;
	#ifdef USE_TANGENT
		varying vec3 vTangent;
		varying vec3 vBitangent;
	#endif
#endif`,kE=`#ifndef FLAT_SHADED
	vNormal = normalize( transformedNormal );
	#ifdef USE_TANGENT
		vTangent = normalize( transformedTangent );
		vBitangent = normalize( cross( vNormal, vTangent ) * tangent.w );
		#ifdef FLIP_SIDED
			vBitangent = - vBitangent;
		#endif
	#endif
#endif`,zE=`#ifdef USE_NORMALMAP
	uniform sampler2D normalMap;
	uniform vec2 normalScale;
#endif
#ifdef USE_NORMALMAP_OBJECTSPACE
	uniform mat3 normalMatrix;
#endif
#if ! defined ( USE_TANGENT ) && ( defined ( USE_NORMALMAP_TANGENTSPACE ) || defined ( USE_CLEARCOAT_NORMALMAP ) || defined( USE_ANISOTROPY ) )
	mat3 getTangentFrame( vec3 eye_pos, vec3 surf_norm, vec2 uv ) {
		vec3 q0 = dFdx( eye_pos.xyz );
		vec3 q1 = dFdy( eye_pos.xyz );
		vec2 st0 = dFdx( uv.st );
		vec2 st1 = dFdy( uv.st );
		vec3 N = surf_norm;
		vec3 q1perp = cross( q1, N );
		vec3 q0perp = cross( N, q0 );
		vec3 T = q1perp * st0.x + q0perp * st1.x;
		vec3 B = q1perp * st0.y + q0perp * st1.y;
		float det = max( dot( T, T ), dot( B, B ) );
		float scale = ( det == 0.0 ) ? 0.0 : inversesqrt( det );
		return mat3( T * scale, B * scale, N );
	}
#endif`,VE=`#ifdef USE_CLEARCOAT
	vec3 clearcoatNormal = nonPerturbedNormal;
#endif`,GE=`#ifdef USE_CLEARCOAT_NORMALMAP
	vec3 clearcoatMapN = texture2D( clearcoatNormalMap, vClearcoatNormalMapUv ).xyz * 2.0 - 1.0;
	clearcoatMapN.xy *= clearcoatNormalScale;
	clearcoatNormal = normalize( tbn2 * clearcoatMapN );
#endif`,HE=`#ifdef USE_CLEARCOATMAP
	uniform sampler2D clearcoatMap;
#endif
#ifdef USE_CLEARCOAT_NORMALMAP
	uniform sampler2D clearcoatNormalMap;
	uniform vec2 clearcoatNormalScale;
#endif
#ifdef USE_CLEARCOAT_ROUGHNESSMAP
	uniform sampler2D clearcoatRoughnessMap;
#endif`,WE=`#ifdef USE_IRIDESCENCEMAP
	uniform sampler2D iridescenceMap;
#endif
#ifdef USE_IRIDESCENCE_THICKNESSMAP
	uniform sampler2D iridescenceThicknessMap;
#endif`,XE=`#ifdef OPAQUE
diffuseColor.a = 1.0;
#endif
#ifdef USE_TRANSMISSION
diffuseColor.a *= material.transmissionAlpha;
#endif
gl_FragColor = vec4( outgoingLight, diffuseColor.a );`,qE=`vec3 packNormalToRGB( const in vec3 normal ) {
	return normalize( normal ) * 0.5 + 0.5;
}
vec3 unpackRGBToNormal( const in vec3 rgb ) {
	return 2.0 * rgb.xyz - 1.0;
}
const float PackUpscale = 256. / 255.;const float UnpackDownscale = 255. / 256.;const float ShiftRight8 = 1. / 256.;
const float Inv255 = 1. / 255.;
const vec4 PackFactors = vec4( 1.0, 256.0, 256.0 * 256.0, 256.0 * 256.0 * 256.0 );
const vec2 UnpackFactors2 = vec2( UnpackDownscale, 1.0 / PackFactors.g );
const vec3 UnpackFactors3 = vec3( UnpackDownscale / PackFactors.rg, 1.0 / PackFactors.b );
const vec4 UnpackFactors4 = vec4( UnpackDownscale / PackFactors.rgb, 1.0 / PackFactors.a );
vec4 packDepthToRGBA( const in float v ) {
	if( v <= 0.0 )
		return vec4( 0., 0., 0., 0. );
	if( v >= 1.0 )
		return vec4( 1., 1., 1., 1. );
	float vuf;
	float af = modf( v * PackFactors.a, vuf );
	float bf = modf( vuf * ShiftRight8, vuf );
	float gf = modf( vuf * ShiftRight8, vuf );
	return vec4( vuf * Inv255, gf * PackUpscale, bf * PackUpscale, af );
}
vec3 packDepthToRGB( const in float v ) {
	if( v <= 0.0 )
		return vec3( 0., 0., 0. );
	if( v >= 1.0 )
		return vec3( 1., 1., 1. );
	float vuf;
	float bf = modf( v * PackFactors.b, vuf );
	float gf = modf( vuf * ShiftRight8, vuf );
	return vec3( vuf * Inv255, gf * PackUpscale, bf );
}
vec2 packDepthToRG( const in float v ) {
	if( v <= 0.0 )
		return vec2( 0., 0. );
	if( v >= 1.0 )
		return vec2( 1., 1. );
	float vuf;
	float gf = modf( v * 256., vuf );
	return vec2( vuf * Inv255, gf );
}
float unpackRGBAToDepth( const in vec4 v ) {
	return dot( v, UnpackFactors4 );
}
float unpackRGBToDepth( const in vec3 v ) {
	return dot( v, UnpackFactors3 );
}
float unpackRGToDepth( const in vec2 v ) {
	return v.r * UnpackFactors2.r + v.g * UnpackFactors2.g;
}
vec4 pack2HalfToRGBA( const in vec2 v ) {
	vec4 r = vec4( v.x, fract( v.x * 255.0 ), v.y, fract( v.y * 255.0 ) );
	return vec4( r.x - r.y / 255.0, r.y, r.z - r.w / 255.0, r.w );
}
vec2 unpackRGBATo2Half( const in vec4 v ) {
	return vec2( v.x + ( v.y / 255.0 ), v.z + ( v.w / 255.0 ) );
}
float viewZToOrthographicDepth( const in float viewZ, const in float near, const in float far ) {
	return ( viewZ + near ) / ( near - far );
}
float orthographicDepthToViewZ( const in float depth, const in float near, const in float far ) {
	#ifdef USE_REVERSED_DEPTH_BUFFER
	
		return depth * ( far - near ) - far;
	#else
		return depth * ( near - far ) - near;
	#endif
}
float viewZToPerspectiveDepth( const in float viewZ, const in float near, const in float far ) {
	return ( ( near + viewZ ) * far ) / ( ( far - near ) * viewZ );
}
float perspectiveDepthToViewZ( const in float depth, const in float near, const in float far ) {
	
	#ifdef USE_REVERSED_DEPTH_BUFFER
		return ( near * far ) / ( ( near - far ) * depth - near );
	#else
		return ( near * far ) / ( ( far - near ) * depth - far );
	#endif
}`,jE=`#ifdef PREMULTIPLIED_ALPHA
	gl_FragColor.rgb *= gl_FragColor.a;
#endif`,YE=`vec4 mvPosition = vec4( transformed, 1.0 );
#ifdef USE_BATCHING
	mvPosition = batchingMatrix * mvPosition;
#endif
#ifdef USE_INSTANCING
	mvPosition = instanceMatrix * mvPosition;
#endif
mvPosition = modelViewMatrix * mvPosition;
gl_Position = projectionMatrix * mvPosition;`,$E=`#ifdef DITHERING
	gl_FragColor.rgb = dithering( gl_FragColor.rgb );
#endif`,JE=`#ifdef DITHERING
	vec3 dithering( vec3 color ) {
		float grid_position = rand( gl_FragCoord.xy );
		vec3 dither_shift_RGB = vec3( 0.25 / 255.0, -0.25 / 255.0, 0.25 / 255.0 );
		dither_shift_RGB = mix( 2.0 * dither_shift_RGB, -2.0 * dither_shift_RGB, grid_position );
		return color + dither_shift_RGB;
	}
#endif`,KE=`float roughnessFactor = roughness;
#ifdef USE_ROUGHNESSMAP
	vec4 texelRoughness = texture2D( roughnessMap, vRoughnessMapUv );
	roughnessFactor *= texelRoughness.g;
#endif`,ZE=`#ifdef USE_ROUGHNESSMAP
	uniform sampler2D roughnessMap;
#endif`,QE=`#if NUM_SPOT_LIGHT_COORDS > 0
	varying vec4 vSpotLightCoord[ NUM_SPOT_LIGHT_COORDS ];
#endif
#if NUM_SPOT_LIGHT_MAPS > 0
	uniform sampler2D spotLightMap[ NUM_SPOT_LIGHT_MAPS ];
#endif
#ifdef USE_SHADOWMAP
	#if NUM_SUN_LIGHT_SHADOWS > 0
		#define SUN_LIGHT_CASCADES 2
		#if defined( SHADOWMAP_TYPE_PCF )
			uniform sampler2DShadow sunShadowMap[ NUM_SUN_LIGHT_SHADOWS ];
		#else
			uniform sampler2D sunShadowMap[ NUM_SUN_LIGHT_SHADOWS ];
		#endif
		uniform mat4 sunShadowMatrix[ NUM_SUN_LIGHT_SHADOWS * SUN_LIGHT_CASCADES ];
		uniform vec4 sunShadowCascade[ NUM_SUN_LIGHT_SHADOWS * SUN_LIGHT_CASCADES ];
		varying vec4 vSunShadowWorldPosition;
		varying vec3 vSunShadowWorldNormal;
		struct SunLightShadow {
			float shadowIntensity;
			float shadowBias;
			float shadowNormalBias;
			float shadowRadius;
			vec2 shadowMapSize;
		};
		uniform SunLightShadow sunLightShadows[ NUM_SUN_LIGHT_SHADOWS ];
	#endif
	#if NUM_DIR_LIGHT_SHADOWS > 0
		#if defined( SHADOWMAP_TYPE_PCF )
			uniform sampler2DShadow directionalShadowMap[ NUM_DIR_LIGHT_SHADOWS ];
		#else
			uniform sampler2D directionalShadowMap[ NUM_DIR_LIGHT_SHADOWS ];
		#endif
		varying vec4 vDirectionalShadowCoord[ NUM_DIR_LIGHT_SHADOWS ];
		struct DirectionalLightShadow {
			float shadowIntensity;
			float shadowBias;
			float shadowNormalBias;
			float shadowRadius;
			vec2 shadowMapSize;
		};
		uniform DirectionalLightShadow directionalLightShadows[ NUM_DIR_LIGHT_SHADOWS ];
	#endif
	#if NUM_SPOT_LIGHT_SHADOWS > 0
		#if defined( SHADOWMAP_TYPE_PCF )
			uniform sampler2DShadow spotShadowMap[ NUM_SPOT_LIGHT_SHADOWS ];
		#else
			uniform sampler2D spotShadowMap[ NUM_SPOT_LIGHT_SHADOWS ];
		#endif
		struct SpotLightShadow {
			float shadowIntensity;
			float shadowBias;
			float shadowNormalBias;
			float shadowRadius;
			vec2 shadowMapSize;
		};
		uniform SpotLightShadow spotLightShadows[ NUM_SPOT_LIGHT_SHADOWS ];
	#endif
	#if NUM_POINT_LIGHT_SHADOWS > 0
		#if defined( SHADOWMAP_TYPE_PCF )
			uniform samplerCubeShadow pointShadowMap[ NUM_POINT_LIGHT_SHADOWS ];
		#elif defined( SHADOWMAP_TYPE_BASIC )
			uniform samplerCube pointShadowMap[ NUM_POINT_LIGHT_SHADOWS ];
		#endif
		varying vec4 vPointShadowCoord[ NUM_POINT_LIGHT_SHADOWS ];
		struct PointLightShadow {
			float shadowIntensity;
			float shadowBias;
			float shadowNormalBias;
			float shadowRadius;
			vec2 shadowMapSize;
			float shadowCameraNear;
			float shadowCameraFar;
		};
		uniform PointLightShadow pointLightShadows[ NUM_POINT_LIGHT_SHADOWS ];
	#endif
	#if defined( SHADOWMAP_TYPE_PCF )
		float interleavedGradientNoise( vec2 position ) {
			return fract( 52.9829189 * fract( dot( position, vec2( 0.06711056, 0.00583715 ) ) ) );
		}
		vec2 vogelDiskSample( int sampleIndex, int samplesCount, float phi ) {
			const float goldenAngle = 2.399963229728653;
			float r = sqrt( ( float( sampleIndex ) + 0.5 ) / float( samplesCount ) );
			float theta = float( sampleIndex ) * goldenAngle + phi;
			return vec2( cos( theta ), sin( theta ) ) * r;
		}
	#endif
	#if defined( SHADOWMAP_TYPE_PCF )
		float getShadow( sampler2DShadow shadowMap, vec2 shadowMapSize, float shadowIntensity, float shadowBias, float shadowRadius, vec4 shadowCoord ) {
			float shadow = 1.0;
			shadowCoord.xyz /= shadowCoord.w;
			#ifdef USE_REVERSED_DEPTH_BUFFER
				shadowCoord.z -= shadowBias;
			#else
				shadowCoord.z += shadowBias;
			#endif
			bool inFrustum = shadowCoord.x >= 0.0 && shadowCoord.x <= 1.0 && shadowCoord.y >= 0.0 && shadowCoord.y <= 1.0;
			bool frustumTest = inFrustum && shadowCoord.z <= 1.0;
			if ( frustumTest ) {
				vec2 texelSize = vec2( 1.0 ) / shadowMapSize;
				vec2 radius = shadowRadius * texelSize;
				float phi = interleavedGradientNoise( gl_FragCoord.xy ) * PI2;
				shadow = (
					texture( shadowMap, vec3( shadowCoord.xy + vogelDiskSample( 0, 5, phi ) * radius, shadowCoord.z ) ) +
					texture( shadowMap, vec3( shadowCoord.xy + vogelDiskSample( 1, 5, phi ) * radius, shadowCoord.z ) ) +
					texture( shadowMap, vec3( shadowCoord.xy + vogelDiskSample( 2, 5, phi ) * radius, shadowCoord.z ) ) +
					texture( shadowMap, vec3( shadowCoord.xy + vogelDiskSample( 3, 5, phi ) * radius, shadowCoord.z ) ) +
					texture( shadowMap, vec3( shadowCoord.xy + vogelDiskSample( 4, 5, phi ) * radius, shadowCoord.z ) )
				) * 0.2;
			}
			return mix( 1.0, shadow, shadowIntensity );
		}
	#elif defined( SHADOWMAP_TYPE_VSM )
		float getShadow( sampler2D shadowMap, vec2 shadowMapSize, float shadowIntensity, float shadowBias, float shadowRadius, vec4 shadowCoord ) {
			float shadow = 1.0;
			shadowCoord.xyz /= shadowCoord.w;
			#ifdef USE_REVERSED_DEPTH_BUFFER
				shadowCoord.z -= shadowBias;
			#else
				shadowCoord.z += shadowBias;
			#endif
			bool inFrustum = shadowCoord.x >= 0.0 && shadowCoord.x <= 1.0 && shadowCoord.y >= 0.0 && shadowCoord.y <= 1.0;
			bool frustumTest = inFrustum && shadowCoord.z <= 1.0;
			if ( frustumTest ) {
				vec2 distribution = texture2D( shadowMap, shadowCoord.xy ).rg;
				float mean = distribution.x;
				float variance = distribution.y * distribution.y;
				#ifdef USE_REVERSED_DEPTH_BUFFER
					float hard_shadow = step( mean, shadowCoord.z );
				#else
					float hard_shadow = step( shadowCoord.z, mean );
				#endif
				
				if ( hard_shadow == 1.0 ) {
					shadow = 1.0;
				} else {
					variance = max( variance, 0.0000001 );
					float d = shadowCoord.z - mean;
					float p_max = variance / ( variance + d * d );
					p_max = clamp( ( p_max - 0.3 ) / 0.65, 0.0, 1.0 );
					shadow = max( hard_shadow, p_max );
				}
			}
			return mix( 1.0, shadow, shadowIntensity );
		}
	#else
		float getShadow( sampler2D shadowMap, vec2 shadowMapSize, float shadowIntensity, float shadowBias, float shadowRadius, vec4 shadowCoord ) {
			float shadow = 1.0;
			shadowCoord.xyz /= shadowCoord.w;
			#ifdef USE_REVERSED_DEPTH_BUFFER
				shadowCoord.z -= shadowBias;
			#else
				shadowCoord.z += shadowBias;
			#endif
			bool inFrustum = shadowCoord.x >= 0.0 && shadowCoord.x <= 1.0 && shadowCoord.y >= 0.0 && shadowCoord.y <= 1.0;
			bool frustumTest = inFrustum && shadowCoord.z <= 1.0;
			if ( frustumTest ) {
				float depth = texture2D( shadowMap, shadowCoord.xy ).r;
				#ifdef USE_REVERSED_DEPTH_BUFFER
					shadow = step( depth, shadowCoord.z );
				#else
					shadow = step( shadowCoord.z, depth );
				#endif
			}
			return mix( 1.0, shadow, shadowIntensity );
		}
	#endif
	#if NUM_SUN_LIGHT_SHADOWS > 0
		float getSunShadow(
			#if defined( SHADOWMAP_TYPE_PCF )
				sampler2DShadow shadowMap,
			#else
				sampler2D shadowMap,
			#endif
			SunLightShadow sunLightShadow,
			int shadowIndex
		) {
			vec4 shadowWorldPosition = vec4( vSunShadowWorldPosition.xyz + vSunShadowWorldNormal * sunLightShadow.shadowNormalBias, 1.0 );
			float viewDepth = vSunShadowWorldPosition.w;
			int cascadeOffset = shadowIndex * SUN_LIGHT_CASCADES;
			float shadow = 1.0;
			for ( int i = SUN_LIGHT_CASCADES - 1; i >= 0; i -- ) {
				vec4 cascade = sunShadowCascade[ cascadeOffset + i ];
				if ( viewDepth >= cascade.x && viewDepth < cascade.y ) {
					float cascadeShadow = getShadow(
						shadowMap,
						sunLightShadow.shadowMapSize,
						sunLightShadow.shadowIntensity,
						sunLightShadow.shadowBias,
						sunLightShadow.shadowRadius,
						sunShadowMatrix[ cascadeOffset + i ] * shadowWorldPosition
					);
					shadow = mix( cascadeShadow, shadow, smoothstep( cascade.z, cascade.y, viewDepth ) );
				}
			}
			return shadow;
		}
	#endif
	#if NUM_POINT_LIGHT_SHADOWS > 0
	#if defined( SHADOWMAP_TYPE_PCF )
	float getPointShadow( samplerCubeShadow shadowMap, vec2 shadowMapSize, float shadowIntensity, float shadowBias, float shadowRadius, vec4 shadowCoord, float shadowCameraNear, float shadowCameraFar ) {
		float shadow = 1.0;
		vec3 lightToPosition = shadowCoord.xyz;
		vec3 bd3D = normalize( lightToPosition );
		vec3 absVec = abs( lightToPosition );
		float viewSpaceZ = max( max( absVec.x, absVec.y ), absVec.z );
		if ( viewSpaceZ - shadowCameraFar <= 0.0 && viewSpaceZ - shadowCameraNear >= 0.0 ) {
			float lightDistance = length( lightToPosition );
			float depthRange = shadowCameraFar - shadowCameraNear;
			#ifdef USE_REVERSED_DEPTH_BUFFER
				float depthA = - shadowCameraNear / depthRange - shadowBias;
				float depthB = shadowCameraNear * shadowCameraFar / ( depthRange * lightDistance );
			#else
				float depthA = shadowCameraFar / depthRange + shadowBias;
				float depthB = - shadowCameraNear * shadowCameraFar / ( depthRange * lightDistance );
			#endif
			float texelSize = shadowRadius / shadowMapSize.x;
			vec3 absDir = abs( bd3D );
			vec3 tangent = absDir.x > absDir.z ? vec3( 0.0, 1.0, 0.0 ) : vec3( 1.0, 0.0, 0.0 );
			tangent = normalize( cross( bd3D, tangent ) );
			vec3 bitangent = cross( bd3D, tangent );
			float phi = interleavedGradientNoise( gl_FragCoord.xy ) * PI2;
			shadow = 0.0;
			for ( int i = 0; i < 5; i ++ ) {
				vec2 offset = vogelDiskSample( i, 5, phi );
				vec3 direction = bd3D + ( tangent * offset.x + bitangent * offset.y ) * texelSize;
				vec3 absDirection = abs( direction );
				float dp = depthA + depthB / max( max( absDirection.x, absDirection.y ), absDirection.z );
				shadow += texture( shadowMap, vec4( direction, dp ) );
			}
			shadow *= 0.2;
		}
		return mix( 1.0, shadow, shadowIntensity );
	}
	#elif defined( SHADOWMAP_TYPE_BASIC )
	float getPointShadow( samplerCube shadowMap, vec2 shadowMapSize, float shadowIntensity, float shadowBias, float shadowRadius, vec4 shadowCoord, float shadowCameraNear, float shadowCameraFar ) {
		float shadow = 1.0;
		vec3 lightToPosition = shadowCoord.xyz;
		vec3 absVec = abs( lightToPosition );
		float viewSpaceZ = max( max( absVec.x, absVec.y ), absVec.z );
		if ( viewSpaceZ - shadowCameraFar <= 0.0 && viewSpaceZ - shadowCameraNear >= 0.0 ) {
			float dp = ( shadowCameraFar * ( viewSpaceZ - shadowCameraNear ) ) / ( viewSpaceZ * ( shadowCameraFar - shadowCameraNear ) );
			dp += shadowBias;
			vec3 bd3D = normalize( lightToPosition );
			float depth = textureCube( shadowMap, bd3D ).r;
			#ifdef USE_REVERSED_DEPTH_BUFFER
				depth = 1.0 - depth;
			#endif
			shadow = step( dp, depth );
		}
		return mix( 1.0, shadow, shadowIntensity );
	}
	#endif
	#endif
#endif`,t1=`#if NUM_SPOT_LIGHT_COORDS > 0
	uniform mat4 spotLightMatrix[ NUM_SPOT_LIGHT_COORDS ];
	varying vec4 vSpotLightCoord[ NUM_SPOT_LIGHT_COORDS ];
#endif
#ifdef USE_SHADOWMAP
	#if NUM_SUN_LIGHT_SHADOWS > 0
		varying vec4 vSunShadowWorldPosition;
		varying vec3 vSunShadowWorldNormal;
	#endif
	#if NUM_DIR_LIGHT_SHADOWS > 0
		uniform mat4 directionalShadowMatrix[ NUM_DIR_LIGHT_SHADOWS ];
		varying vec4 vDirectionalShadowCoord[ NUM_DIR_LIGHT_SHADOWS ];
		struct DirectionalLightShadow {
			float shadowIntensity;
			float shadowBias;
			float shadowNormalBias;
			float shadowRadius;
			vec2 shadowMapSize;
		};
		uniform DirectionalLightShadow directionalLightShadows[ NUM_DIR_LIGHT_SHADOWS ];
	#endif
	#if NUM_SPOT_LIGHT_SHADOWS > 0
		struct SpotLightShadow {
			float shadowIntensity;
			float shadowBias;
			float shadowNormalBias;
			float shadowRadius;
			vec2 shadowMapSize;
		};
		uniform SpotLightShadow spotLightShadows[ NUM_SPOT_LIGHT_SHADOWS ];
	#endif
	#if NUM_POINT_LIGHT_SHADOWS > 0
		uniform mat4 pointShadowMatrix[ NUM_POINT_LIGHT_SHADOWS ];
		varying vec4 vPointShadowCoord[ NUM_POINT_LIGHT_SHADOWS ];
		struct PointLightShadow {
			float shadowIntensity;
			float shadowBias;
			float shadowNormalBias;
			float shadowRadius;
			vec2 shadowMapSize;
			float shadowCameraNear;
			float shadowCameraFar;
		};
		uniform PointLightShadow pointLightShadows[ NUM_POINT_LIGHT_SHADOWS ];
	#endif
#endif`,e1=`#if ( defined( USE_SHADOWMAP ) && ( NUM_DIR_LIGHT_SHADOWS > 0 || NUM_SUN_LIGHT_SHADOWS > 0 || NUM_POINT_LIGHT_SHADOWS > 0 ) ) || ( NUM_SPOT_LIGHT_COORDS > 0 )
	#ifdef HAS_NORMAL
		vec3 shadowWorldNormal = transformNormalByInverseViewMatrix( transformedNormal, viewMatrix );
	#else
		vec3 shadowWorldNormal = vec3( 0.0 );
	#endif
	vec4 shadowWorldPosition;
#endif
#if defined( USE_SHADOWMAP )
	#if NUM_SUN_LIGHT_SHADOWS > 0
		vSunShadowWorldPosition = vec4( worldPosition.xyz, - mvPosition.z );
		vSunShadowWorldNormal = shadowWorldNormal;
	#endif
	#if NUM_DIR_LIGHT_SHADOWS > 0
		#pragma unroll_loop_start
		for ( int i = 0; i < NUM_DIR_LIGHT_SHADOWS; i ++ ) {
			shadowWorldPosition = worldPosition + vec4( shadowWorldNormal * directionalLightShadows[ i ].shadowNormalBias, 0 );
			vDirectionalShadowCoord[ i ] = directionalShadowMatrix[ i ] * shadowWorldPosition;
		}
		#pragma unroll_loop_end
	#endif
	#if NUM_POINT_LIGHT_SHADOWS > 0
		#pragma unroll_loop_start
		for ( int i = 0; i < NUM_POINT_LIGHT_SHADOWS; i ++ ) {
			shadowWorldPosition = worldPosition + vec4( shadowWorldNormal * pointLightShadows[ i ].shadowNormalBias, 0 );
			vPointShadowCoord[ i ] = pointShadowMatrix[ i ] * shadowWorldPosition;
		}
		#pragma unroll_loop_end
	#endif
#endif
#if NUM_SPOT_LIGHT_COORDS > 0
	#pragma unroll_loop_start
	for ( int i = 0; i < NUM_SPOT_LIGHT_COORDS; i ++ ) {
		shadowWorldPosition = worldPosition;
		#if ( defined( USE_SHADOWMAP ) && UNROLLED_LOOP_INDEX < NUM_SPOT_LIGHT_SHADOWS )
			shadowWorldPosition.xyz += shadowWorldNormal * spotLightShadows[ i ].shadowNormalBias;
		#endif
		vSpotLightCoord[ i ] = spotLightMatrix[ i ] * shadowWorldPosition;
	}
	#pragma unroll_loop_end
#endif`,n1=`float getShadowMask() {
	float shadow = 1.0;
	#ifdef USE_SHADOWMAP
	#if NUM_SUN_LIGHT_SHADOWS > 0
	SunLightShadow sunLight;
	#pragma unroll_loop_start
	for ( int i = 0; i < NUM_SUN_LIGHT_SHADOWS; i ++ ) {
		sunLight = sunLightShadows[ i ];
		shadow *= receiveShadow ? getSunShadow( sunShadowMap[ i ], sunLight, UNROLLED_LOOP_INDEX ) : 1.0;
	}
	#pragma unroll_loop_end
	#endif
	#if NUM_DIR_LIGHT_SHADOWS > 0
	DirectionalLightShadow directionalLight;
	#pragma unroll_loop_start
	for ( int i = 0; i < NUM_DIR_LIGHT_SHADOWS; i ++ ) {
		directionalLight = directionalLightShadows[ i ];
		shadow *= receiveShadow ? getShadow( directionalShadowMap[ i ], directionalLight.shadowMapSize, directionalLight.shadowIntensity, directionalLight.shadowBias, directionalLight.shadowRadius, vDirectionalShadowCoord[ i ] ) : 1.0;
	}
	#pragma unroll_loop_end
	#endif
	#if NUM_SPOT_LIGHT_SHADOWS > 0
	SpotLightShadow spotLight;
	#pragma unroll_loop_start
	for ( int i = 0; i < NUM_SPOT_LIGHT_SHADOWS; i ++ ) {
		spotLight = spotLightShadows[ i ];
		shadow *= receiveShadow ? getShadow( spotShadowMap[ i ], spotLight.shadowMapSize, spotLight.shadowIntensity, spotLight.shadowBias, spotLight.shadowRadius, vSpotLightCoord[ i ] ) : 1.0;
	}
	#pragma unroll_loop_end
	#endif
	#if NUM_POINT_LIGHT_SHADOWS > 0 && ( defined( SHADOWMAP_TYPE_PCF ) || defined( SHADOWMAP_TYPE_BASIC ) )
	PointLightShadow pointLight;
	#pragma unroll_loop_start
	for ( int i = 0; i < NUM_POINT_LIGHT_SHADOWS; i ++ ) {
		pointLight = pointLightShadows[ i ];
		shadow *= receiveShadow ? getPointShadow( pointShadowMap[ i ], pointLight.shadowMapSize, pointLight.shadowIntensity, pointLight.shadowBias, pointLight.shadowRadius, vPointShadowCoord[ i ], pointLight.shadowCameraNear, pointLight.shadowCameraFar ) : 1.0;
	}
	#pragma unroll_loop_end
	#endif
	#endif
	return shadow;
}`,i1=`#ifdef USE_SKINNING
	mat4 boneMatX = getBoneMatrix( skinIndex.x );
	mat4 boneMatY = getBoneMatrix( skinIndex.y );
	mat4 boneMatZ = getBoneMatrix( skinIndex.z );
	mat4 boneMatW = getBoneMatrix( skinIndex.w );
#endif`,s1=`#ifdef USE_SKINNING
	uniform mat4 bindMatrix;
	uniform mat4 bindMatrixInverse;
	uniform highp sampler2D boneTexture;
	mat4 getBoneMatrix( const in float i ) {
		int size = textureSize( boneTexture, 0 ).x;
		int j = int( i ) * 4;
		int x = j % size;
		int y = j / size;
		vec4 v1 = texelFetch( boneTexture, ivec2( x, y ), 0 );
		vec4 v2 = texelFetch( boneTexture, ivec2( x + 1, y ), 0 );
		vec4 v3 = texelFetch( boneTexture, ivec2( x + 2, y ), 0 );
		vec4 v4 = texelFetch( boneTexture, ivec2( x + 3, y ), 0 );
		return mat4( v1, v2, v3, v4 );
	}
#endif`,r1=`#ifdef USE_SKINNING
	vec4 skinVertex = bindMatrix * vec4( transformed, 1.0 );
	vec4 skinned = vec4( 0.0 );
	skinned += boneMatX * skinVertex * skinWeight.x;
	skinned += boneMatY * skinVertex * skinWeight.y;
	skinned += boneMatZ * skinVertex * skinWeight.z;
	skinned += boneMatW * skinVertex * skinWeight.w;
	transformed = ( bindMatrixInverse * skinned ).xyz;
#endif`,o1=`#ifdef USE_SKINNING
	mat4 skinMatrix = mat4( 0.0 );
	skinMatrix += skinWeight.x * boneMatX;
	skinMatrix += skinWeight.y * boneMatY;
	skinMatrix += skinWeight.z * boneMatZ;
	skinMatrix += skinWeight.w * boneMatW;
	skinMatrix = bindMatrixInverse * skinMatrix * bindMatrix;
	objectNormal = vec4( skinMatrix * vec4( objectNormal, 0.0 ) ).xyz;
	#ifdef USE_TANGENT
		objectTangent = vec4( skinMatrix * vec4( objectTangent, 0.0 ) ).xyz;
	#endif
#endif`,a1=`float specularStrength;
#ifdef USE_SPECULARMAP
	vec4 texelSpecular = texture2D( specularMap, vSpecularMapUv );
	specularStrength = texelSpecular.r;
#else
	specularStrength = 1.0;
#endif`,l1=`#ifdef USE_SPECULARMAP
	uniform sampler2D specularMap;
#endif`,c1=`#if defined( TONE_MAPPING )
	gl_FragColor.rgb = toneMapping( gl_FragColor.rgb );
#endif`,h1=`#ifndef saturate
#define saturate( a ) clamp( a, 0.0, 1.0 )
#endif
uniform float toneMappingExposure;
vec3 LinearToneMapping( vec3 color ) {
	return saturate( toneMappingExposure * color );
}
vec3 ReinhardToneMapping( vec3 color ) {
	color *= toneMappingExposure;
	return saturate( color / ( vec3( 1.0 ) + color ) );
}
vec3 CineonToneMapping( vec3 color ) {
	color *= toneMappingExposure;
	color = max( vec3( 0.0 ), color - 0.004 );
	return pow( ( color * ( 6.2 * color + 0.5 ) ) / ( color * ( 6.2 * color + 1.7 ) + 0.06 ), vec3( 2.2 ) );
}
vec3 RRTAndODTFit( vec3 v ) {
	vec3 a = v * ( v + 0.0245786 ) - 0.000090537;
	vec3 b = v * ( 0.983729 * v + 0.4329510 ) + 0.238081;
	return a / b;
}
vec3 ACESFilmicToneMapping( vec3 color ) {
	const mat3 ACESInputMat = mat3(
		vec3( 0.59719, 0.07600, 0.02840 ),		vec3( 0.35458, 0.90834, 0.13383 ),
		vec3( 0.04823, 0.01566, 0.83777 )
	);
	const mat3 ACESOutputMat = mat3(
		vec3(  1.60475, -0.10208, -0.00327 ),		vec3( -0.53108,  1.10813, -0.07276 ),
		vec3( -0.07367, -0.00605,  1.07602 )
	);
	color *= toneMappingExposure / 0.6;
	color = ACESInputMat * color;
	color = RRTAndODTFit( color );
	color = ACESOutputMat * color;
	return saturate( color );
}
const mat3 LINEAR_REC2020_TO_LINEAR_SRGB = mat3(
	vec3( 1.6605, - 0.1246, - 0.0182 ),
	vec3( - 0.5876, 1.1329, - 0.1006 ),
	vec3( - 0.0728, - 0.0083, 1.1187 )
);
const mat3 LINEAR_SRGB_TO_LINEAR_REC2020 = mat3(
	vec3( 0.6274, 0.0691, 0.0164 ),
	vec3( 0.3293, 0.9195, 0.0880 ),
	vec3( 0.0433, 0.0113, 0.8956 )
);
vec3 agxDefaultContrastApprox( vec3 x ) {
	vec3 x2 = x * x;
	vec3 x4 = x2 * x2;
	return + 15.5 * x4 * x2
		- 40.14 * x4 * x
		+ 31.96 * x4
		- 6.868 * x2 * x
		+ 0.4298 * x2
		+ 0.1191 * x
		- 0.00232;
}
vec3 AgXToneMapping( vec3 color ) {
	const mat3 AgXInsetMatrix = mat3(
		vec3( 0.856627153315983, 0.137318972929847, 0.11189821299995 ),
		vec3( 0.0951212405381588, 0.761241990602591, 0.0767994186031903 ),
		vec3( 0.0482516061458583, 0.101439036467562, 0.811302368396859 )
	);
	const mat3 AgXOutsetMatrix = mat3(
		vec3( 1.1271005818144368, - 0.1413297634984383, - 0.14132976349843826 ),
		vec3( - 0.11060664309660323, 1.157823702216272, - 0.11060664309660294 ),
		vec3( - 0.016493938717834573, - 0.016493938717834257, 1.2519364065950405 )
	);
	const float AgxMinEv = - 12.47393;	const float AgxMaxEv = 4.026069;
	color *= toneMappingExposure;
	color = LINEAR_SRGB_TO_LINEAR_REC2020 * color;
	color = AgXInsetMatrix * color;
	color = max( color, 1e-10 );	color = log2( color );
	color = ( color - AgxMinEv ) / ( AgxMaxEv - AgxMinEv );
	color = clamp( color, 0.0, 1.0 );
	color = agxDefaultContrastApprox( color );
	color = AgXOutsetMatrix * color;
	color = pow( max( vec3( 0.0 ), color ), vec3( 2.2 ) );
	color = LINEAR_REC2020_TO_LINEAR_SRGB * color;
	color = clamp( color, 0.0, 1.0 );
	return color;
}
vec3 NeutralToneMapping( vec3 color ) {
	const float StartCompression = 0.8 - 0.04;
	const float Desaturation = 0.15;
	color *= toneMappingExposure;
	float x = min( color.r, min( color.g, color.b ) );
	float offset = x < 0.08 ? x - 6.25 * x * x : 0.04;
	color -= offset;
	float peak = max( color.r, max( color.g, color.b ) );
	if ( peak < StartCompression ) return color;
	float d = 1. - StartCompression;
	float newPeak = 1. - d * d / ( peak + d - StartCompression );
	color *= newPeak / peak;
	float g = 1. - 1. / ( Desaturation * ( peak - newPeak ) + 1. );
	return mix( color, vec3( newPeak ), g );
}
vec3 CustomToneMapping( vec3 color ) { return color; }`,u1=`#ifdef USE_TRANSMISSION
	material.transmission = transmission;
	material.transmissionAlpha = 1.0;
	material.thickness = thickness;
	material.attenuationDistance = attenuationDistance;
	material.attenuationColor = attenuationColor;
	#ifdef USE_TRANSMISSIONMAP
		material.transmission *= texture2D( transmissionMap, vTransmissionMapUv ).r;
	#endif
	#ifdef USE_THICKNESSMAP
		material.thickness *= texture2D( thicknessMap, vThicknessMapUv ).g;
	#endif
	vec3 pos = vWorldPosition;
	vec3 v = normalize( cameraPosition - pos );
	vec3 n = transformNormalByInverseViewMatrix( normal, viewMatrix );
	vec4 transmitted = getIBLVolumeRefraction(
		n, v, material.roughness, material.diffuseContribution, material.specularColorBlended, material.specularF90,
		pos, modelMatrix, viewMatrix, projectionMatrix, material.dispersion, material.ior, material.thickness,
		material.attenuationColor, material.attenuationDistance );
	material.transmissionAlpha = mix( material.transmissionAlpha, transmitted.a, material.transmission );
	totalDiffuse = mix( totalDiffuse, transmitted.rgb, material.transmission );
#endif`,d1=`#ifdef USE_TRANSMISSION
	uniform float transmission;
	uniform float thickness;
	uniform float attenuationDistance;
	uniform vec3 attenuationColor;
	#ifdef USE_TRANSMISSIONMAP
		uniform sampler2D transmissionMap;
	#endif
	#ifdef USE_THICKNESSMAP
		uniform sampler2D thicknessMap;
	#endif
	uniform vec2 transmissionSamplerSize;
	uniform sampler2D transmissionSamplerMap;
	uniform mat4 modelMatrix;
	uniform mat4 projectionMatrix;
	varying vec3 vWorldPosition;
	float w0( float a ) {
		return ( 1.0 / 6.0 ) * ( a * ( a * ( - a + 3.0 ) - 3.0 ) + 1.0 );
	}
	float w1( float a ) {
		return ( 1.0 / 6.0 ) * ( a *  a * ( 3.0 * a - 6.0 ) + 4.0 );
	}
	float w2( float a ){
		return ( 1.0 / 6.0 ) * ( a * ( a * ( - 3.0 * a + 3.0 ) + 3.0 ) + 1.0 );
	}
	float w3( float a ) {
		return ( 1.0 / 6.0 ) * ( a * a * a );
	}
	float g0( float a ) {
		return w0( a ) + w1( a );
	}
	float g1( float a ) {
		return w2( a ) + w3( a );
	}
	float h0( float a ) {
		return - 1.0 + w1( a ) / ( w0( a ) + w1( a ) );
	}
	float h1( float a ) {
		return 1.0 + w3( a ) / ( w2( a ) + w3( a ) );
	}
	vec4 bicubic( sampler2D tex, vec2 uv, vec4 texelSize, float lod ) {
		uv = uv * texelSize.zw + 0.5;
		vec2 iuv = floor( uv );
		vec2 fuv = fract( uv );
		float g0x = g0( fuv.x );
		float g1x = g1( fuv.x );
		float h0x = h0( fuv.x );
		float h1x = h1( fuv.x );
		float h0y = h0( fuv.y );
		float h1y = h1( fuv.y );
		vec2 p0 = ( vec2( iuv.x + h0x, iuv.y + h0y ) - 0.5 ) * texelSize.xy;
		vec2 p1 = ( vec2( iuv.x + h1x, iuv.y + h0y ) - 0.5 ) * texelSize.xy;
		vec2 p2 = ( vec2( iuv.x + h0x, iuv.y + h1y ) - 0.5 ) * texelSize.xy;
		vec2 p3 = ( vec2( iuv.x + h1x, iuv.y + h1y ) - 0.5 ) * texelSize.xy;
		return g0( fuv.y ) * ( g0x * textureLod( tex, p0, lod ) + g1x * textureLod( tex, p1, lod ) ) +
			g1( fuv.y ) * ( g0x * textureLod( tex, p2, lod ) + g1x * textureLod( tex, p3, lod ) );
	}
	vec4 textureBicubic( sampler2D sampler, vec2 uv, float lod ) {
		vec2 fLodSize = vec2( textureSize( sampler, int( lod ) ) );
		vec2 cLodSize = vec2( textureSize( sampler, int( lod + 1.0 ) ) );
		vec2 fLodSizeInv = 1.0 / fLodSize;
		vec2 cLodSizeInv = 1.0 / cLodSize;
		vec4 fSample = bicubic( sampler, uv, vec4( fLodSizeInv, fLodSize ), floor( lod ) );
		vec4 cSample = bicubic( sampler, uv, vec4( cLodSizeInv, cLodSize ), ceil( lod ) );
		return mix( fSample, cSample, fract( lod ) );
	}
	vec3 getVolumeTransmissionRay( const in vec3 n, const in vec3 v, const in float thickness, const in float ior, const in mat4 modelMatrix ) {
		vec3 refractionVector = refract( - v, normalize( n ), 1.0 / ior );
		vec3 modelScale;
		modelScale.x = length( vec3( modelMatrix[ 0 ].xyz ) );
		modelScale.y = length( vec3( modelMatrix[ 1 ].xyz ) );
		modelScale.z = length( vec3( modelMatrix[ 2 ].xyz ) );
		return normalize( refractionVector ) * thickness * modelScale;
	}
	float applyIorToRoughness( const in float roughness, const in float ior ) {
		return roughness * clamp( ior * 2.0 - 2.0, 0.0, 1.0 );
	}
	vec4 getTransmissionSample( const in vec2 fragCoord, const in float roughness, const in float ior ) {
		float lod = log2( transmissionSamplerSize.x ) * applyIorToRoughness( roughness, ior );
		return textureBicubic( transmissionSamplerMap, fragCoord.xy, lod );
	}
	vec3 volumeAttenuation( const in float transmissionDistance, const in vec3 attenuationColor, const in float attenuationDistance ) {
		if ( isinf( attenuationDistance ) ) {
			return vec3( 1.0 );
		} else {
			vec3 attenuationCoefficient = -log( attenuationColor ) / attenuationDistance;
			vec3 transmittance = exp( - attenuationCoefficient * transmissionDistance );			return transmittance;
		}
	}
	vec4 getIBLVolumeRefraction( const in vec3 n, const in vec3 v, const in float roughness, const in vec3 diffuseColor,
		const in vec3 specularColor, const in float specularF90, const in vec3 position, const in mat4 modelMatrix,
		const in mat4 viewMatrix, const in mat4 projMatrix, const in float dispersion, const in float ior, const in float thickness,
		const in vec3 attenuationColor, const in float attenuationDistance ) {
		vec4 transmittedLight;
		vec3 transmittance;
		#ifdef USE_DISPERSION
			float halfSpread = ( ior - 1.0 ) * 0.025 * dispersion;
			vec3 iors = vec3( ior - halfSpread, ior, ior + halfSpread );
			for ( int i = 0; i < 3; i ++ ) {
				vec3 transmissionRay = getVolumeTransmissionRay( n, v, thickness, iors[ i ], modelMatrix );
				vec3 refractedRayExit = position + transmissionRay;
				vec4 ndcPos = projMatrix * viewMatrix * vec4( refractedRayExit, 1.0 );
				vec2 refractionCoords = ndcPos.xy / ndcPos.w;
				refractionCoords += 1.0;
				refractionCoords /= 2.0;
				vec4 transmissionSample = getTransmissionSample( refractionCoords, roughness, iors[ i ] );
				transmittedLight[ i ] = transmissionSample[ i ];
				transmittedLight.a += transmissionSample.a;
				transmittance[ i ] = diffuseColor[ i ] * volumeAttenuation( length( transmissionRay ), attenuationColor, attenuationDistance )[ i ];
			}
			transmittedLight.a /= 3.0;
		#else
			vec3 transmissionRay = getVolumeTransmissionRay( n, v, thickness, ior, modelMatrix );
			vec3 refractedRayExit = position + transmissionRay;
			vec4 ndcPos = projMatrix * viewMatrix * vec4( refractedRayExit, 1.0 );
			vec2 refractionCoords = ndcPos.xy / ndcPos.w;
			refractionCoords += 1.0;
			refractionCoords /= 2.0;
			transmittedLight = getTransmissionSample( refractionCoords, roughness, ior );
			transmittance = diffuseColor * volumeAttenuation( length( transmissionRay ), attenuationColor, attenuationDistance );
		#endif
		vec3 attenuatedColor = transmittance * transmittedLight.rgb;
		vec3 F = EnvironmentBRDF( n, v, specularColor, specularF90, roughness );
		float transmittanceFactor = ( transmittance.r + transmittance.g + transmittance.b ) / 3.0;
		return vec4( ( 1.0 - F ) * attenuatedColor, 1.0 - ( 1.0 - transmittedLight.a ) * transmittanceFactor );
	}
#endif`,f1=`#if defined( USE_UV ) || defined( USE_ANISOTROPY )
	varying vec2 vUv;
#endif
#ifdef USE_MAP
	varying vec2 vMapUv;
#endif
#ifdef USE_ALPHAMAP
	varying vec2 vAlphaMapUv;
#endif
#ifdef USE_LIGHTMAP
	varying vec2 vLightMapUv;
#endif
#ifdef USE_AOMAP
	varying vec2 vAoMapUv;
#endif
#ifdef USE_BUMPMAP
	varying vec2 vBumpMapUv;
#endif
#ifdef USE_NORMALMAP
	varying vec2 vNormalMapUv;
#endif
#ifdef USE_EMISSIVEMAP
	varying vec2 vEmissiveMapUv;
#endif
#ifdef USE_METALNESSMAP
	varying vec2 vMetalnessMapUv;
#endif
#ifdef USE_ROUGHNESSMAP
	varying vec2 vRoughnessMapUv;
#endif
#ifdef USE_DIFFUSE_ROUGHNESSMAP
	varying vec2 vDiffuseRoughnessMapUv;
#endif
#ifdef USE_ANISOTROPYMAP
	varying vec2 vAnisotropyMapUv;
#endif
#ifdef USE_CLEARCOATMAP
	varying vec2 vClearcoatMapUv;
#endif
#ifdef USE_CLEARCOAT_NORMALMAP
	varying vec2 vClearcoatNormalMapUv;
#endif
#ifdef USE_CLEARCOAT_ROUGHNESSMAP
	varying vec2 vClearcoatRoughnessMapUv;
#endif
#ifdef USE_IRIDESCENCEMAP
	varying vec2 vIridescenceMapUv;
#endif
#ifdef USE_IRIDESCENCE_THICKNESSMAP
	varying vec2 vIridescenceThicknessMapUv;
#endif
#ifdef USE_SHEEN_COLORMAP
	varying vec2 vSheenColorMapUv;
#endif
#ifdef USE_SHEEN_ROUGHNESSMAP
	varying vec2 vSheenRoughnessMapUv;
#endif
#ifdef USE_SPECULARMAP
	varying vec2 vSpecularMapUv;
#endif
#ifdef USE_SPECULAR_COLORMAP
	varying vec2 vSpecularColorMapUv;
#endif
#ifdef USE_SPECULAR_INTENSITYMAP
	varying vec2 vSpecularIntensityMapUv;
#endif
#ifdef USE_TRANSMISSIONMAP
	uniform mat3 transmissionMapTransform;
	varying vec2 vTransmissionMapUv;
#endif
#ifdef USE_THICKNESSMAP
	uniform mat3 thicknessMapTransform;
	varying vec2 vThicknessMapUv;
#endif`,p1=`#if defined( USE_UV ) || defined( USE_ANISOTROPY )
	varying vec2 vUv;
#endif
#ifdef USE_MAP
	uniform mat3 mapTransform;
	varying vec2 vMapUv;
#endif
#ifdef USE_ALPHAMAP
	uniform mat3 alphaMapTransform;
	varying vec2 vAlphaMapUv;
#endif
#ifdef USE_LIGHTMAP
	uniform mat3 lightMapTransform;
	varying vec2 vLightMapUv;
#endif
#ifdef USE_AOMAP
	uniform mat3 aoMapTransform;
	varying vec2 vAoMapUv;
#endif
#ifdef USE_BUMPMAP
	uniform mat3 bumpMapTransform;
	varying vec2 vBumpMapUv;
#endif
#ifdef USE_NORMALMAP
	uniform mat3 normalMapTransform;
	varying vec2 vNormalMapUv;
#endif
#ifdef USE_DISPLACEMENTMAP
	uniform mat3 displacementMapTransform;
	varying vec2 vDisplacementMapUv;
#endif
#ifdef USE_EMISSIVEMAP
	uniform mat3 emissiveMapTransform;
	varying vec2 vEmissiveMapUv;
#endif
#ifdef USE_METALNESSMAP
	uniform mat3 metalnessMapTransform;
	varying vec2 vMetalnessMapUv;
#endif
#ifdef USE_ROUGHNESSMAP
	uniform mat3 roughnessMapTransform;
	varying vec2 vRoughnessMapUv;
#endif
#ifdef USE_DIFFUSE_ROUGHNESSMAP
	uniform mat3 diffuseRoughnessMapTransform;
	varying vec2 vDiffuseRoughnessMapUv;
#endif
#ifdef USE_ANISOTROPYMAP
	uniform mat3 anisotropyMapTransform;
	varying vec2 vAnisotropyMapUv;
#endif
#ifdef USE_CLEARCOATMAP
	uniform mat3 clearcoatMapTransform;
	varying vec2 vClearcoatMapUv;
#endif
#ifdef USE_CLEARCOAT_NORMALMAP
	uniform mat3 clearcoatNormalMapTransform;
	varying vec2 vClearcoatNormalMapUv;
#endif
#ifdef USE_CLEARCOAT_ROUGHNESSMAP
	uniform mat3 clearcoatRoughnessMapTransform;
	varying vec2 vClearcoatRoughnessMapUv;
#endif
#ifdef USE_SHEEN_COLORMAP
	uniform mat3 sheenColorMapTransform;
	varying vec2 vSheenColorMapUv;
#endif
#ifdef USE_SHEEN_ROUGHNESSMAP
	uniform mat3 sheenRoughnessMapTransform;
	varying vec2 vSheenRoughnessMapUv;
#endif
#ifdef USE_IRIDESCENCEMAP
	uniform mat3 iridescenceMapTransform;
	varying vec2 vIridescenceMapUv;
#endif
#ifdef USE_IRIDESCENCE_THICKNESSMAP
	uniform mat3 iridescenceThicknessMapTransform;
	varying vec2 vIridescenceThicknessMapUv;
#endif
#ifdef USE_SPECULARMAP
	uniform mat3 specularMapTransform;
	varying vec2 vSpecularMapUv;
#endif
#ifdef USE_SPECULAR_COLORMAP
	uniform mat3 specularColorMapTransform;
	varying vec2 vSpecularColorMapUv;
#endif
#ifdef USE_SPECULAR_INTENSITYMAP
	uniform mat3 specularIntensityMapTransform;
	varying vec2 vSpecularIntensityMapUv;
#endif
#ifdef USE_TRANSMISSIONMAP
	uniform mat3 transmissionMapTransform;
	varying vec2 vTransmissionMapUv;
#endif
#ifdef USE_THICKNESSMAP
	uniform mat3 thicknessMapTransform;
	varying vec2 vThicknessMapUv;
#endif`,m1=`#if defined( USE_UV ) || defined( USE_ANISOTROPY )
	vUv = vec3( uv, 1 ).xy;
#endif
#ifdef USE_MAP
	vMapUv = ( mapTransform * vec3( MAP_UV, 1 ) ).xy;
#endif
#ifdef USE_ALPHAMAP
	vAlphaMapUv = ( alphaMapTransform * vec3( ALPHAMAP_UV, 1 ) ).xy;
#endif
#ifdef USE_LIGHTMAP
	vLightMapUv = ( lightMapTransform * vec3( LIGHTMAP_UV, 1 ) ).xy;
#endif
#ifdef USE_AOMAP
	vAoMapUv = ( aoMapTransform * vec3( AOMAP_UV, 1 ) ).xy;
#endif
#ifdef USE_BUMPMAP
	vBumpMapUv = ( bumpMapTransform * vec3( BUMPMAP_UV, 1 ) ).xy;
#endif
#ifdef USE_NORMALMAP
	vNormalMapUv = ( normalMapTransform * vec3( NORMALMAP_UV, 1 ) ).xy;
#endif
#ifdef USE_DISPLACEMENTMAP
	vDisplacementMapUv = ( displacementMapTransform * vec3( DISPLACEMENTMAP_UV, 1 ) ).xy;
#endif
#ifdef USE_EMISSIVEMAP
	vEmissiveMapUv = ( emissiveMapTransform * vec3( EMISSIVEMAP_UV, 1 ) ).xy;
#endif
#ifdef USE_METALNESSMAP
	vMetalnessMapUv = ( metalnessMapTransform * vec3( METALNESSMAP_UV, 1 ) ).xy;
#endif
#ifdef USE_ROUGHNESSMAP
	vRoughnessMapUv = ( roughnessMapTransform * vec3( ROUGHNESSMAP_UV, 1 ) ).xy;
#endif
#ifdef USE_DIFFUSE_ROUGHNESSMAP
	vDiffuseRoughnessMapUv = ( diffuseRoughnessMapTransform * vec3( DIFFUSE_ROUGHNESSMAP_UV, 1 ) ).xy;
#endif
#ifdef USE_ANISOTROPYMAP
	vAnisotropyMapUv = ( anisotropyMapTransform * vec3( ANISOTROPYMAP_UV, 1 ) ).xy;
#endif
#ifdef USE_CLEARCOATMAP
	vClearcoatMapUv = ( clearcoatMapTransform * vec3( CLEARCOATMAP_UV, 1 ) ).xy;
#endif
#ifdef USE_CLEARCOAT_NORMALMAP
	vClearcoatNormalMapUv = ( clearcoatNormalMapTransform * vec3( CLEARCOAT_NORMALMAP_UV, 1 ) ).xy;
#endif
#ifdef USE_CLEARCOAT_ROUGHNESSMAP
	vClearcoatRoughnessMapUv = ( clearcoatRoughnessMapTransform * vec3( CLEARCOAT_ROUGHNESSMAP_UV, 1 ) ).xy;
#endif
#ifdef USE_IRIDESCENCEMAP
	vIridescenceMapUv = ( iridescenceMapTransform * vec3( IRIDESCENCEMAP_UV, 1 ) ).xy;
#endif
#ifdef USE_IRIDESCENCE_THICKNESSMAP
	vIridescenceThicknessMapUv = ( iridescenceThicknessMapTransform * vec3( IRIDESCENCE_THICKNESSMAP_UV, 1 ) ).xy;
#endif
#ifdef USE_SHEEN_COLORMAP
	vSheenColorMapUv = ( sheenColorMapTransform * vec3( SHEEN_COLORMAP_UV, 1 ) ).xy;
#endif
#ifdef USE_SHEEN_ROUGHNESSMAP
	vSheenRoughnessMapUv = ( sheenRoughnessMapTransform * vec3( SHEEN_ROUGHNESSMAP_UV, 1 ) ).xy;
#endif
#ifdef USE_SPECULARMAP
	vSpecularMapUv = ( specularMapTransform * vec3( SPECULARMAP_UV, 1 ) ).xy;
#endif
#ifdef USE_SPECULAR_COLORMAP
	vSpecularColorMapUv = ( specularColorMapTransform * vec3( SPECULAR_COLORMAP_UV, 1 ) ).xy;
#endif
#ifdef USE_SPECULAR_INTENSITYMAP
	vSpecularIntensityMapUv = ( specularIntensityMapTransform * vec3( SPECULAR_INTENSITYMAP_UV, 1 ) ).xy;
#endif
#ifdef USE_TRANSMISSIONMAP
	vTransmissionMapUv = ( transmissionMapTransform * vec3( TRANSMISSIONMAP_UV, 1 ) ).xy;
#endif
#ifdef USE_THICKNESSMAP
	vThicknessMapUv = ( thicknessMapTransform * vec3( THICKNESSMAP_UV, 1 ) ).xy;
#endif`,g1=`#if defined( USE_ENVMAP ) || defined( DISTANCE ) || defined ( USE_SHADOWMAP ) || defined ( USE_TRANSMISSION ) || NUM_SPOT_LIGHT_COORDS > 0
	vec4 worldPosition = vec4( transformed, 1.0 );
	#ifdef USE_BATCHING
		worldPosition = batchingMatrix * worldPosition;
	#endif
	#ifdef USE_INSTANCING
		worldPosition = instanceMatrix * worldPosition;
	#endif
	worldPosition = modelMatrix * worldPosition;
#endif`,y1=`varying vec2 vUv;
uniform mat3 uvTransform;
void main() {
	vUv = ( uvTransform * vec3( uv, 1 ) ).xy;
	gl_Position = vec4( position.xy, 1.0, 1.0 );
}`,_1=`uniform sampler2D t2D;
uniform float backgroundIntensity;
varying vec2 vUv;
void main() {
	vec4 texColor = texture2D( t2D, vUv );
	#ifdef DECODE_VIDEO_TEXTURE
		texColor = vec4( mix( pow( texColor.rgb * 0.9478672986 + vec3( 0.0521327014 ), vec3( 2.4 ) ), texColor.rgb * 0.0773993808, vec3( lessThanEqual( texColor.rgb, vec3( 0.04045 ) ) ) ), texColor.w );
	#endif
	texColor.rgb *= backgroundIntensity;
	gl_FragColor = texColor;
	#include <tonemapping_fragment>
	#include <colorspace_fragment>
}`,x1=`varying vec3 vWorldDirection;
#include <common>
void main() {
	vWorldDirection = transformDirection( position, modelMatrix );
	#include <begin_vertex>
	#include <project_vertex>
	gl_Position.z = gl_Position.w;
}`,v1=`uniform float backgroundBlurriness;
uniform float backgroundIntensity;
uniform mat3 backgroundRotation;
varying vec3 vWorldDirection;
#include <envmap_common_pars_fragment>
void main() {
	#ifdef ENVMAP_TYPE_PMREM
		vec4 texColor = textureLod( envMap, backgroundRotation * vWorldDirection, roughnessToMip( backgroundBlurriness ) );
	#else
		vec4 texColor = textureCube( envMap, backgroundRotation * vWorldDirection );
	#endif
	texColor.rgb *= backgroundIntensity;
	gl_FragColor = texColor;
	#include <tonemapping_fragment>
	#include <colorspace_fragment>
}`,b1=`varying vec3 vWorldDirection;
#include <common>
void main() {
	vWorldDirection = transformDirection( position, modelMatrix );
	#include <begin_vertex>
	#include <project_vertex>
	gl_Position.z = gl_Position.w;
}`,S1=`uniform samplerCube tCube;
uniform float tFlip;
uniform float opacity;
varying vec3 vWorldDirection;
void main() {
	vec4 texColor = textureCube( tCube, vec3( tFlip * vWorldDirection.x, vWorldDirection.yz ) );
	gl_FragColor = texColor;
	gl_FragColor.a *= opacity;
	#include <tonemapping_fragment>
	#include <colorspace_fragment>
}`,M1=`#include <common>
#include <batching_pars_vertex>
#include <uv_pars_vertex>
#include <displacementmap_pars_vertex>
#include <morphtarget_pars_vertex>
#include <skinning_pars_vertex>
#include <logdepthbuf_pars_vertex>
#include <clipping_planes_pars_vertex>
varying vec2 vHighPrecisionZW;
void main() {
	#include <uv_vertex>
	#include <batching_vertex>
	#include <skinbase_vertex>
	#include <morphinstance_vertex>
	#ifdef USE_DISPLACEMENTMAP
		#include <beginnormal_vertex>
		#include <morphnormal_vertex>
		#include <skinnormal_vertex>
	#endif
	#include <begin_vertex>
	#include <morphtarget_vertex>
	#include <skinning_vertex>
	#include <displacementmap_vertex>
	#include <project_vertex>
	#include <logdepthbuf_vertex>
	#include <clipping_planes_vertex>
	vHighPrecisionZW = gl_Position.zw;
}`,w1=`#if DEPTH_PACKING == 3200
	uniform float opacity;
#endif
#include <common>
#include <packing>
#include <uv_pars_fragment>
#include <map_pars_fragment>
#include <alphamap_pars_fragment>
#include <alphatest_pars_fragment>
#include <alphahash_pars_fragment>
#include <logdepthbuf_pars_fragment>
#include <clipping_planes_pars_fragment>
varying vec2 vHighPrecisionZW;
void main() {
	vec4 diffuseColor = vec4( 1.0 );
	#include <clipping_planes_fragment>
	#if DEPTH_PACKING == 3200
		diffuseColor.a = opacity;
	#endif
	#include <map_fragment>
	#include <alphamap_fragment>
	#include <alphatest_fragment>
	#include <alphahash_fragment>
	#include <logdepthbuf_fragment>
	#ifdef USE_REVERSED_DEPTH_BUFFER
		float fragCoordZ = vHighPrecisionZW[ 0 ] / vHighPrecisionZW[ 1 ];
	#else
		float fragCoordZ = 0.5 * vHighPrecisionZW[ 0 ] / vHighPrecisionZW[ 1 ] + 0.5;
	#endif
	#if DEPTH_PACKING == 3200
		gl_FragColor = vec4( vec3( 1.0 - fragCoordZ ), opacity );
	#elif DEPTH_PACKING == 3201
		gl_FragColor = packDepthToRGBA( fragCoordZ );
	#elif DEPTH_PACKING == 3202
		gl_FragColor = vec4( packDepthToRGB( fragCoordZ ), 1.0 );
	#elif DEPTH_PACKING == 3203
		gl_FragColor = vec4( packDepthToRG( fragCoordZ ), 0.0, 1.0 );
	#endif
}`,T1=`#define DISTANCE
varying vec3 vWorldPosition;
#include <common>
#include <batching_pars_vertex>
#include <uv_pars_vertex>
#include <displacementmap_pars_vertex>
#include <morphtarget_pars_vertex>
#include <skinning_pars_vertex>
#include <clipping_planes_pars_vertex>
void main() {
	#include <uv_vertex>
	#include <batching_vertex>
	#include <skinbase_vertex>
	#include <morphinstance_vertex>
	#ifdef USE_DISPLACEMENTMAP
		#include <beginnormal_vertex>
		#include <morphnormal_vertex>
		#include <skinnormal_vertex>
	#endif
	#include <begin_vertex>
	#include <morphtarget_vertex>
	#include <skinning_vertex>
	#include <displacementmap_vertex>
	#include <project_vertex>
	#include <worldpos_vertex>
	#include <clipping_planes_vertex>
	vWorldPosition = worldPosition.xyz;
}`,A1=`#define DISTANCE
uniform vec3 referencePosition;
uniform float nearDistance;
uniform float farDistance;
varying vec3 vWorldPosition;
#include <common>
#include <uv_pars_fragment>
#include <map_pars_fragment>
#include <alphamap_pars_fragment>
#include <alphatest_pars_fragment>
#include <alphahash_pars_fragment>
#include <clipping_planes_pars_fragment>
void main() {
	vec4 diffuseColor = vec4( 1.0 );
	#include <clipping_planes_fragment>
	#include <map_fragment>
	#include <alphamap_fragment>
	#include <alphatest_fragment>
	#include <alphahash_fragment>
	float dist = length( vWorldPosition - referencePosition );
	dist = ( dist - nearDistance ) / ( farDistance - nearDistance );
	dist = saturate( dist );
	gl_FragColor = vec4( dist, 0.0, 0.0, 1.0 );
}`,E1=`varying vec3 vWorldDirection;
#include <common>
void main() {
	vWorldDirection = transformDirection( position, modelMatrix );
	#include <begin_vertex>
	#include <project_vertex>
}`,C1=`uniform sampler2D tEquirect;
varying vec3 vWorldDirection;
#include <common>
void main() {
	vec3 direction = normalize( vWorldDirection );
	vec2 sampleUV = equirectUv( direction );
	gl_FragColor = texture2D( tEquirect, sampleUV );
	#include <tonemapping_fragment>
	#include <colorspace_fragment>
}`,R1=`uniform float scale;
attribute float lineDistance;
varying float vLineDistance;
#include <common>
#include <uv_pars_vertex>
#include <color_pars_vertex>
#include <fog_pars_vertex>
#include <morphtarget_pars_vertex>
#include <logdepthbuf_pars_vertex>
#include <clipping_planes_pars_vertex>
void main() {
	vLineDistance = scale * lineDistance;
	#include <uv_vertex>
	#include <color_vertex>
	#include <morphinstance_vertex>
	#include <morphcolor_vertex>
	#include <begin_vertex>
	#include <morphtarget_vertex>
	#include <project_vertex>
	#include <logdepthbuf_vertex>
	#include <clipping_planes_vertex>
	#include <fog_vertex>
}`,P1=`uniform vec3 diffuse;
uniform float opacity;
uniform float dashSize;
uniform float totalSize;
varying float vLineDistance;
#include <common>
#include <color_pars_fragment>
#include <uv_pars_fragment>
#include <map_pars_fragment>
#include <fog_pars_fragment>
#include <logdepthbuf_pars_fragment>
#include <clipping_planes_pars_fragment>
void main() {
	vec4 diffuseColor = vec4( diffuse, opacity );
	#include <clipping_planes_fragment>
	if ( mod( vLineDistance, totalSize ) > dashSize ) {
		discard;
	}
	vec3 outgoingLight = vec3( 0.0 );
	#include <logdepthbuf_fragment>
	#include <map_fragment>
	#include <color_fragment>
	outgoingLight = diffuseColor.rgb;
	#include <opaque_fragment>
	#include <tonemapping_fragment>
	#include <colorspace_fragment>
	#include <fog_fragment>
	#include <premultiplied_alpha_fragment>
}`,L1=`#include <common>
#include <batching_pars_vertex>
#include <uv_pars_vertex>
#include <envmap_pars_vertex>
#include <color_pars_vertex>
#include <fog_pars_vertex>
#include <morphtarget_pars_vertex>
#include <skinning_pars_vertex>
#include <logdepthbuf_pars_vertex>
#include <clipping_planes_pars_vertex>
void main() {
	#include <uv_vertex>
	#include <color_vertex>
	#include <morphinstance_vertex>
	#include <morphcolor_vertex>
	#include <batching_vertex>
	#if defined ( USE_ENVMAP ) || defined ( USE_SKINNING )
		#include <beginnormal_vertex>
		#include <morphnormal_vertex>
		#include <skinbase_vertex>
		#include <skinnormal_vertex>
		#include <defaultnormal_vertex>
	#endif
	#include <begin_vertex>
	#include <morphtarget_vertex>
	#include <skinning_vertex>
	#include <project_vertex>
	#include <logdepthbuf_vertex>
	#include <clipping_planes_vertex>
	#include <worldpos_vertex>
	#include <envmap_vertex>
	#include <fog_vertex>
}`,I1=`uniform vec3 diffuse;
uniform float opacity;
#ifndef FLAT_SHADED
	varying vec3 vNormal;
#endif
#include <common>
#include <dithering_pars_fragment>
#include <color_pars_fragment>
#include <uv_pars_fragment>
#include <map_pars_fragment>
#include <alphamap_pars_fragment>
#include <alphatest_pars_fragment>
#include <alphahash_pars_fragment>
#include <aomap_pars_fragment>
#include <lightmap_pars_fragment>
#include <envmap_common_pars_fragment>
#include <envmap_pars_fragment>
#include <fog_pars_fragment>
#include <specularmap_pars_fragment>
#include <logdepthbuf_pars_fragment>
#include <clipping_planes_pars_fragment>
void main() {
	vec4 diffuseColor = vec4( diffuse, opacity );
	#include <clipping_planes_fragment>
	#include <logdepthbuf_fragment>
	#include <map_fragment>
	#include <color_fragment>
	#include <alphamap_fragment>
	#include <alphatest_fragment>
	#include <alphahash_fragment>
	#include <specularmap_fragment>
	ReflectedLight reflectedLight = ReflectedLight( vec3( 0.0 ), vec3( 0.0 ), vec3( 0.0 ), vec3( 0.0 ) );
	#ifdef USE_LIGHTMAP
		vec4 lightMapTexel = texture2D( lightMap, vLightMapUv );
		reflectedLight.indirectDiffuse += lightMapTexel.rgb * lightMapIntensity * RECIPROCAL_PI;
	#else
		reflectedLight.indirectDiffuse += vec3( 1.0 );
	#endif
	#include <aomap_fragment>
	reflectedLight.indirectDiffuse *= diffuseColor.rgb;
	vec3 outgoingLight = reflectedLight.indirectDiffuse;
	#include <envmap_fragment>
	#include <opaque_fragment>
	#include <tonemapping_fragment>
	#include <colorspace_fragment>
	#include <fog_fragment>
	#include <premultiplied_alpha_fragment>
	#include <dithering_fragment>
}`,N1=`#define LAMBERT
varying vec3 vViewPosition;
#include <common>
#include <batching_pars_vertex>
#include <uv_pars_vertex>
#include <displacementmap_pars_vertex>
#include <envmap_pars_vertex>
#include <color_pars_vertex>
#include <fog_pars_vertex>
#include <normal_pars_vertex>
#include <morphtarget_pars_vertex>
#include <skinning_pars_vertex>
#include <shadowmap_pars_vertex>
#include <logdepthbuf_pars_vertex>
#include <clipping_planes_pars_vertex>
void main() {
	#include <uv_vertex>
	#include <color_vertex>
	#include <morphinstance_vertex>
	#include <morphcolor_vertex>
	#include <batching_vertex>
	#include <beginnormal_vertex>
	#include <morphnormal_vertex>
	#include <skinbase_vertex>
	#include <skinnormal_vertex>
	#include <defaultnormal_vertex>
	#include <normal_vertex>
	#include <begin_vertex>
	#include <morphtarget_vertex>
	#include <skinning_vertex>
	#include <displacementmap_vertex>
	#include <project_vertex>
	#include <logdepthbuf_vertex>
	#include <clipping_planes_vertex>
	vViewPosition = - mvPosition.xyz;
	#include <worldpos_vertex>
	#include <envmap_vertex>
	#include <shadowmap_vertex>
	#include <fog_vertex>
}`,D1=`#define LAMBERT
uniform vec3 diffuse;
uniform vec3 emissive;
uniform float opacity;
#include <common>
#include <dithering_pars_fragment>
#include <color_pars_fragment>
#include <uv_pars_fragment>
#include <map_pars_fragment>
#include <alphamap_pars_fragment>
#include <alphatest_pars_fragment>
#include <alphahash_pars_fragment>
#include <aomap_pars_fragment>
#include <lightmap_pars_fragment>
#include <emissivemap_pars_fragment>
#include <envmap_common_pars_fragment>
#include <envmap_pars_fragment>
#include <envmap_physical_pars_fragment>
#include <fog_pars_fragment>
#include <bsdfs>
#include <lights_pars_begin>
#include <normal_pars_fragment>
#include <lights_lambert_pars_fragment>
#include <shadowmap_pars_fragment>
#include <bumpmap_pars_fragment>
#include <normalmap_pars_fragment>
#include <specularmap_pars_fragment>
#include <logdepthbuf_pars_fragment>
#include <clipping_planes_pars_fragment>
void main() {
	vec4 diffuseColor = vec4( diffuse, opacity );
	#include <clipping_planes_fragment>
	ReflectedLight reflectedLight = ReflectedLight( vec3( 0.0 ), vec3( 0.0 ), vec3( 0.0 ), vec3( 0.0 ) );
	vec3 totalEmissiveRadiance = emissive;
	#include <logdepthbuf_fragment>
	#include <map_fragment>
	#include <color_fragment>
	#include <alphamap_fragment>
	#include <alphatest_fragment>
	#include <alphahash_fragment>
	#include <specularmap_fragment>
	#include <normal_fragment_begin>
	#include <normal_fragment_maps>
	#include <emissivemap_fragment>
	#include <lights_lambert_fragment>
	#include <lights_fragment_begin>
	#include <lights_fragment_maps>
	#include <lights_fragment_end>
	#include <aomap_fragment>
	vec3 outgoingLight = reflectedLight.directDiffuse + reflectedLight.indirectDiffuse + totalEmissiveRadiance;
	#include <envmap_fragment>
	#include <opaque_fragment>
	#include <tonemapping_fragment>
	#include <colorspace_fragment>
	#include <fog_fragment>
	#include <premultiplied_alpha_fragment>
	#include <dithering_fragment>
}`,O1=`#define MATCAP
varying vec3 vViewPosition;
#include <common>
#include <batching_pars_vertex>
#include <uv_pars_vertex>
#include <color_pars_vertex>
#include <displacementmap_pars_vertex>
#include <fog_pars_vertex>
#include <normal_pars_vertex>
#include <morphtarget_pars_vertex>
#include <skinning_pars_vertex>
#include <logdepthbuf_pars_vertex>
#include <clipping_planes_pars_vertex>
void main() {
	#include <uv_vertex>
	#include <color_vertex>
	#include <morphinstance_vertex>
	#include <morphcolor_vertex>
	#include <batching_vertex>
	#include <beginnormal_vertex>
	#include <morphnormal_vertex>
	#include <skinbase_vertex>
	#include <skinnormal_vertex>
	#include <defaultnormal_vertex>
	#include <normal_vertex>
	#include <begin_vertex>
	#include <morphtarget_vertex>
	#include <skinning_vertex>
	#include <displacementmap_vertex>
	#include <project_vertex>
	#include <logdepthbuf_vertex>
	#include <clipping_planes_vertex>
	#include <fog_vertex>
	vViewPosition = - mvPosition.xyz;
}`,F1=`#define MATCAP
uniform vec3 diffuse;
uniform float opacity;
uniform sampler2D matcap;
varying vec3 vViewPosition;
#include <common>
#include <dithering_pars_fragment>
#include <color_pars_fragment>
#include <uv_pars_fragment>
#include <map_pars_fragment>
#include <alphamap_pars_fragment>
#include <alphatest_pars_fragment>
#include <alphahash_pars_fragment>
#include <fog_pars_fragment>
#include <normal_pars_fragment>
#include <bumpmap_pars_fragment>
#include <normalmap_pars_fragment>
#include <logdepthbuf_pars_fragment>
#include <clipping_planes_pars_fragment>
void main() {
	vec4 diffuseColor = vec4( diffuse, opacity );
	#include <clipping_planes_fragment>
	#include <logdepthbuf_fragment>
	#include <map_fragment>
	#include <color_fragment>
	#include <alphamap_fragment>
	#include <alphatest_fragment>
	#include <alphahash_fragment>
	#include <normal_fragment_begin>
	#include <normal_fragment_maps>
	vec3 viewDir = normalize( vViewPosition );
	vec3 x = normalize( vec3( viewDir.z, 0.0, - viewDir.x ) );
	vec3 y = cross( viewDir, x );
	vec2 uv = vec2( dot( x, normal ), dot( y, normal ) ) * 0.495 + 0.5;
	#ifdef USE_MATCAP
		vec4 matcapColor = texture2D( matcap, uv );
	#else
		vec4 matcapColor = vec4( vec3( mix( 0.2, 0.8, uv.y ) ), 1.0 );
	#endif
	vec3 outgoingLight = diffuseColor.rgb * matcapColor.rgb;
	#include <opaque_fragment>
	#include <tonemapping_fragment>
	#include <colorspace_fragment>
	#include <fog_fragment>
	#include <premultiplied_alpha_fragment>
	#include <dithering_fragment>
}`,U1=`#define NORMAL
#if defined( FLAT_SHADED ) || defined( USE_BUMPMAP ) || defined( USE_NORMALMAP_TANGENTSPACE )
	varying vec3 vViewPosition;
#endif
#include <common>
#include <batching_pars_vertex>
#include <uv_pars_vertex>
#include <displacementmap_pars_vertex>
#include <normal_pars_vertex>
#include <morphtarget_pars_vertex>
#include <skinning_pars_vertex>
#include <logdepthbuf_pars_vertex>
#include <clipping_planes_pars_vertex>
void main() {
	#include <uv_vertex>
	#include <batching_vertex>
	#include <beginnormal_vertex>
	#include <morphinstance_vertex>
	#include <morphnormal_vertex>
	#include <skinbase_vertex>
	#include <skinnormal_vertex>
	#include <defaultnormal_vertex>
	#include <normal_vertex>
	#include <begin_vertex>
	#include <morphtarget_vertex>
	#include <skinning_vertex>
	#include <displacementmap_vertex>
	#include <project_vertex>
	#include <logdepthbuf_vertex>
	#include <clipping_planes_vertex>
#if defined( FLAT_SHADED ) || defined( USE_BUMPMAP ) || defined( USE_NORMALMAP_TANGENTSPACE )
	vViewPosition = - mvPosition.xyz;
#endif
}`,B1=`#define NORMAL
uniform float opacity;
#if defined( FLAT_SHADED ) || defined( USE_BUMPMAP ) || defined( USE_NORMALMAP_TANGENTSPACE )
	varying vec3 vViewPosition;
#endif
#include <uv_pars_fragment>
#include <normal_pars_fragment>
#include <bumpmap_pars_fragment>
#include <normalmap_pars_fragment>
#include <logdepthbuf_pars_fragment>
#include <clipping_planes_pars_fragment>
void main() {
	vec4 diffuseColor = vec4( 0.0, 0.0, 0.0, opacity );
	#include <clipping_planes_fragment>
	#include <logdepthbuf_fragment>
	#include <normal_fragment_begin>
	#include <normal_fragment_maps>
	gl_FragColor = vec4( normalize( normal ) * 0.5 + 0.5, diffuseColor.a );
	#ifdef OPAQUE
		gl_FragColor.a = 1.0;
	#endif
}`,k1=`#define PHONG
varying vec3 vViewPosition;
#include <common>
#include <batching_pars_vertex>
#include <uv_pars_vertex>
#include <displacementmap_pars_vertex>
#include <envmap_pars_vertex>
#include <color_pars_vertex>
#include <fog_pars_vertex>
#include <normal_pars_vertex>
#include <morphtarget_pars_vertex>
#include <skinning_pars_vertex>
#include <shadowmap_pars_vertex>
#include <logdepthbuf_pars_vertex>
#include <clipping_planes_pars_vertex>
void main() {
	#include <uv_vertex>
	#include <color_vertex>
	#include <morphcolor_vertex>
	#include <batching_vertex>
	#include <beginnormal_vertex>
	#include <morphinstance_vertex>
	#include <morphnormal_vertex>
	#include <skinbase_vertex>
	#include <skinnormal_vertex>
	#include <defaultnormal_vertex>
	#include <normal_vertex>
	#include <begin_vertex>
	#include <morphtarget_vertex>
	#include <skinning_vertex>
	#include <displacementmap_vertex>
	#include <project_vertex>
	#include <logdepthbuf_vertex>
	#include <clipping_planes_vertex>
	vViewPosition = - mvPosition.xyz;
	#include <worldpos_vertex>
	#include <envmap_vertex>
	#include <shadowmap_vertex>
	#include <fog_vertex>
}`,z1=`#define PHONG
uniform vec3 diffuse;
uniform vec3 emissive;
uniform vec3 specular;
uniform float shininess;
uniform float opacity;
#include <common>
#include <dithering_pars_fragment>
#include <color_pars_fragment>
#include <uv_pars_fragment>
#include <map_pars_fragment>
#include <alphamap_pars_fragment>
#include <alphatest_pars_fragment>
#include <alphahash_pars_fragment>
#include <aomap_pars_fragment>
#include <lightmap_pars_fragment>
#include <emissivemap_pars_fragment>
#include <envmap_common_pars_fragment>
#include <envmap_pars_fragment>
#include <envmap_physical_pars_fragment>
#include <fog_pars_fragment>
#include <bsdfs>
#include <lights_pars_begin>
#include <normal_pars_fragment>
#include <lights_phong_pars_fragment>
#include <shadowmap_pars_fragment>
#include <bumpmap_pars_fragment>
#include <normalmap_pars_fragment>
#include <specularmap_pars_fragment>
#include <logdepthbuf_pars_fragment>
#include <clipping_planes_pars_fragment>
void main() {
	vec4 diffuseColor = vec4( diffuse, opacity );
	#include <clipping_planes_fragment>
	ReflectedLight reflectedLight = ReflectedLight( vec3( 0.0 ), vec3( 0.0 ), vec3( 0.0 ), vec3( 0.0 ) );
	vec3 totalEmissiveRadiance = emissive;
	#include <logdepthbuf_fragment>
	#include <map_fragment>
	#include <color_fragment>
	#include <alphamap_fragment>
	#include <alphatest_fragment>
	#include <alphahash_fragment>
	#include <specularmap_fragment>
	#include <normal_fragment_begin>
	#include <normal_fragment_maps>
	#include <emissivemap_fragment>
	#include <lights_phong_fragment>
	#include <lights_fragment_begin>
	#include <lights_fragment_maps>
	#include <lights_fragment_end>
	#include <aomap_fragment>
	vec3 outgoingLight = reflectedLight.directDiffuse + reflectedLight.indirectDiffuse + reflectedLight.directSpecular + reflectedLight.indirectSpecular + totalEmissiveRadiance;
	#include <envmap_fragment>
	#include <opaque_fragment>
	#include <tonemapping_fragment>
	#include <colorspace_fragment>
	#include <fog_fragment>
	#include <premultiplied_alpha_fragment>
	#include <dithering_fragment>
}`,V1=`#define STANDARD
varying vec3 vViewPosition;
#ifdef USE_TRANSMISSION
	varying vec3 vWorldPosition;
#endif
#include <common>
#include <batching_pars_vertex>
#include <uv_pars_vertex>
#include <displacementmap_pars_vertex>
#include <color_pars_vertex>
#include <fog_pars_vertex>
#include <normal_pars_vertex>
#include <morphtarget_pars_vertex>
#include <skinning_pars_vertex>
#include <shadowmap_pars_vertex>
#include <logdepthbuf_pars_vertex>
#include <clipping_planes_pars_vertex>
void main() {
	#include <uv_vertex>
	#include <color_vertex>
	#include <morphinstance_vertex>
	#include <morphcolor_vertex>
	#include <batching_vertex>
	#include <beginnormal_vertex>
	#include <morphnormal_vertex>
	#include <skinbase_vertex>
	#include <skinnormal_vertex>
	#include <defaultnormal_vertex>
	#include <normal_vertex>
	#include <begin_vertex>
	#include <morphtarget_vertex>
	#include <skinning_vertex>
	#include <displacementmap_vertex>
	#include <project_vertex>
	#include <logdepthbuf_vertex>
	#include <clipping_planes_vertex>
	vViewPosition = - mvPosition.xyz;
	#include <worldpos_vertex>
	#include <shadowmap_vertex>
	#include <fog_vertex>
#ifdef USE_TRANSMISSION
	vWorldPosition = worldPosition.xyz;
#endif
}`,G1=`#define STANDARD
#ifdef PHYSICAL
	#define IOR
	#define USE_SPECULAR
#endif
uniform vec3 diffuse;
uniform vec3 emissive;
uniform float roughness;
uniform float metalness;
uniform float opacity;
#ifdef IOR
	uniform float ior;
#endif
#ifdef USE_SPECULAR
	uniform float specularIntensity;
	uniform vec3 specularColor;
	#ifdef USE_SPECULAR_COLORMAP
		uniform sampler2D specularColorMap;
	#endif
	#ifdef USE_SPECULAR_INTENSITYMAP
		uniform sampler2D specularIntensityMap;
	#endif
#endif
#ifdef USE_CLEARCOAT
	uniform float clearcoat;
	uniform float clearcoatRoughness;
#endif
#ifdef USE_DIFFUSE_ROUGHNESS
	uniform float diffuseRoughness;
	#ifdef USE_DIFFUSE_ROUGHNESSMAP
		uniform sampler2D diffuseRoughnessMap;
	#endif
#endif
#ifdef USE_DISPERSION
	uniform float dispersion;
#endif
#ifdef USE_RETROREFLECTION
	uniform float retroreflectivity;
#endif
#ifdef USE_IRIDESCENCE
	uniform float iridescence;
	uniform float iridescenceIOR;
	uniform float iridescenceThicknessMinimum;
	uniform float iridescenceThicknessMaximum;
#endif
#ifdef USE_SHEEN
	uniform vec3 sheenColor;
	uniform float sheenRoughness;
	#ifdef USE_SHEEN_COLORMAP
		uniform sampler2D sheenColorMap;
	#endif
	#ifdef USE_SHEEN_ROUGHNESSMAP
		uniform sampler2D sheenRoughnessMap;
	#endif
#endif
#ifdef USE_ANISOTROPY
	uniform vec2 anisotropyVector;
	#ifdef USE_ANISOTROPYMAP
		uniform sampler2D anisotropyMap;
	#endif
#endif
varying vec3 vViewPosition;
#include <common>
#include <dithering_pars_fragment>
#include <color_pars_fragment>
#include <uv_pars_fragment>
#include <map_pars_fragment>
#include <alphamap_pars_fragment>
#include <alphatest_pars_fragment>
#include <alphahash_pars_fragment>
#include <aomap_pars_fragment>
#include <lightmap_pars_fragment>
#include <emissivemap_pars_fragment>
#include <iridescence_fragment>
#include <envmap_common_pars_fragment>
#include <envmap_physical_pars_fragment>
#include <fog_pars_fragment>
#include <lights_pars_begin>
#include <normal_pars_fragment>
#include <lights_physical_pars_fragment>
#include <transmission_pars_fragment>
#include <shadowmap_pars_fragment>
#include <bumpmap_pars_fragment>
#include <normalmap_pars_fragment>
#include <clearcoat_pars_fragment>
#include <iridescence_pars_fragment>
#include <roughnessmap_pars_fragment>
#include <metalnessmap_pars_fragment>
#include <logdepthbuf_pars_fragment>
#include <clipping_planes_pars_fragment>
void main() {
	vec4 diffuseColor = vec4( diffuse, opacity );
	#include <clipping_planes_fragment>
	ReflectedLight reflectedLight = ReflectedLight( vec3( 0.0 ), vec3( 0.0 ), vec3( 0.0 ), vec3( 0.0 ) );
	vec3 totalEmissiveRadiance = emissive;
	#include <logdepthbuf_fragment>
	#include <map_fragment>
	#include <color_fragment>
	#include <alphamap_fragment>
	#include <alphatest_fragment>
	#include <alphahash_fragment>
	#include <roughnessmap_fragment>
	#include <metalnessmap_fragment>
	#include <normal_fragment_begin>
	#include <normal_fragment_maps>
	#include <clearcoat_normal_fragment_begin>
	#include <clearcoat_normal_fragment_maps>
	#include <emissivemap_fragment>
	#include <lights_physical_fragment>
	#include <lights_fragment_begin>
	#include <lights_fragment_maps>
	#include <lights_fragment_end>
	#include <aomap_fragment>
	vec3 totalDiffuse = reflectedLight.directDiffuse + reflectedLight.indirectDiffuse;
	vec3 totalSpecular = reflectedLight.directSpecular + reflectedLight.indirectSpecular;
	#include <transmission_fragment>
	vec3 outgoingLight = totalDiffuse + totalSpecular + totalEmissiveRadiance;
	#ifdef USE_SHEEN
 
		outgoingLight = outgoingLight + sheenSpecularDirect + sheenSpecularIndirect;
 
 	#endif
	#ifdef USE_CLEARCOAT
		float dotNVcc = saturate( dot( geometryClearcoatNormal, geometryViewDir ) );
		vec3 Fcc = F_Schlick( material.clearcoatF0, material.clearcoatF90, dotNVcc );
		outgoingLight = outgoingLight * ( 1.0 - material.clearcoat * Fcc ) + ( clearcoatSpecularDirect + clearcoatSpecularIndirect ) * material.clearcoat;
	#endif
	#include <opaque_fragment>
	#include <tonemapping_fragment>
	#include <colorspace_fragment>
	#include <fog_fragment>
	#include <premultiplied_alpha_fragment>
	#include <dithering_fragment>
}`,H1=`#define TOON
varying vec3 vViewPosition;
#include <common>
#include <batching_pars_vertex>
#include <uv_pars_vertex>
#include <displacementmap_pars_vertex>
#include <color_pars_vertex>
#include <fog_pars_vertex>
#include <normal_pars_vertex>
#include <morphtarget_pars_vertex>
#include <skinning_pars_vertex>
#include <shadowmap_pars_vertex>
#include <logdepthbuf_pars_vertex>
#include <clipping_planes_pars_vertex>
void main() {
	#include <uv_vertex>
	#include <color_vertex>
	#include <morphinstance_vertex>
	#include <morphcolor_vertex>
	#include <batching_vertex>
	#include <beginnormal_vertex>
	#include <morphnormal_vertex>
	#include <skinbase_vertex>
	#include <skinnormal_vertex>
	#include <defaultnormal_vertex>
	#include <normal_vertex>
	#include <begin_vertex>
	#include <morphtarget_vertex>
	#include <skinning_vertex>
	#include <displacementmap_vertex>
	#include <project_vertex>
	#include <logdepthbuf_vertex>
	#include <clipping_planes_vertex>
	vViewPosition = - mvPosition.xyz;
	#include <worldpos_vertex>
	#include <shadowmap_vertex>
	#include <fog_vertex>
}`,W1=`#define TOON
uniform vec3 diffuse;
uniform vec3 emissive;
uniform float opacity;
#include <common>
#include <dithering_pars_fragment>
#include <color_pars_fragment>
#include <uv_pars_fragment>
#include <map_pars_fragment>
#include <alphamap_pars_fragment>
#include <alphatest_pars_fragment>
#include <alphahash_pars_fragment>
#include <aomap_pars_fragment>
#include <lightmap_pars_fragment>
#include <emissivemap_pars_fragment>
#include <gradientmap_pars_fragment>
#include <fog_pars_fragment>
#include <bsdfs>
#include <lights_pars_begin>
#include <normal_pars_fragment>
#include <lights_toon_pars_fragment>
#include <shadowmap_pars_fragment>
#include <bumpmap_pars_fragment>
#include <normalmap_pars_fragment>
#include <logdepthbuf_pars_fragment>
#include <clipping_planes_pars_fragment>
void main() {
	vec4 diffuseColor = vec4( diffuse, opacity );
	#include <clipping_planes_fragment>
	ReflectedLight reflectedLight = ReflectedLight( vec3( 0.0 ), vec3( 0.0 ), vec3( 0.0 ), vec3( 0.0 ) );
	vec3 totalEmissiveRadiance = emissive;
	#include <logdepthbuf_fragment>
	#include <map_fragment>
	#include <color_fragment>
	#include <alphamap_fragment>
	#include <alphatest_fragment>
	#include <alphahash_fragment>
	#include <normal_fragment_begin>
	#include <normal_fragment_maps>
	#include <emissivemap_fragment>
	#include <lights_toon_fragment>
	#include <lights_fragment_begin>
	#include <lights_fragment_maps>
	#include <lights_fragment_end>
	#include <aomap_fragment>
	vec3 outgoingLight = reflectedLight.directDiffuse + reflectedLight.indirectDiffuse + totalEmissiveRadiance;
	#include <opaque_fragment>
	#include <tonemapping_fragment>
	#include <colorspace_fragment>
	#include <fog_fragment>
	#include <premultiplied_alpha_fragment>
	#include <dithering_fragment>
}`,X1=`uniform float size;
uniform float scale;
#include <common>
#include <color_pars_vertex>
#include <fog_pars_vertex>
#include <morphtarget_pars_vertex>
#include <logdepthbuf_pars_vertex>
#include <clipping_planes_pars_vertex>
#ifdef USE_POINTS_UV
	varying vec2 vUv;
	uniform mat3 uvTransform;
#endif
void main() {
	#ifdef USE_POINTS_UV
		vUv = ( uvTransform * vec3( uv, 1 ) ).xy;
	#endif
	#include <color_vertex>
	#include <morphinstance_vertex>
	#include <morphcolor_vertex>
	#include <begin_vertex>
	#include <morphtarget_vertex>
	#include <project_vertex>
	gl_PointSize = size;
	#ifdef USE_SIZEATTENUATION
		bool isPerspective = isPerspectiveMatrix( projectionMatrix );
		if ( isPerspective ) gl_PointSize *= ( scale / - mvPosition.z );
	#endif
	#include <logdepthbuf_vertex>
	#include <clipping_planes_vertex>
	#include <worldpos_vertex>
	#include <fog_vertex>
}`,q1=`uniform vec3 diffuse;
uniform float opacity;
#include <common>
#include <color_pars_fragment>
#include <map_particle_pars_fragment>
#include <alphatest_pars_fragment>
#include <alphahash_pars_fragment>
#include <fog_pars_fragment>
#include <logdepthbuf_pars_fragment>
#include <clipping_planes_pars_fragment>
void main() {
	vec4 diffuseColor = vec4( diffuse, opacity );
	#include <clipping_planes_fragment>
	vec3 outgoingLight = vec3( 0.0 );
	#include <logdepthbuf_fragment>
	#include <map_particle_fragment>
	#include <color_fragment>
	#include <alphatest_fragment>
	#include <alphahash_fragment>
	outgoingLight = diffuseColor.rgb;
	#include <opaque_fragment>
	#include <tonemapping_fragment>
	#include <colorspace_fragment>
	#include <fog_fragment>
	#include <premultiplied_alpha_fragment>
}`,j1=`#include <common>
#include <batching_pars_vertex>
#include <fog_pars_vertex>
#include <morphtarget_pars_vertex>
#include <skinning_pars_vertex>
#include <logdepthbuf_pars_vertex>
#include <shadowmap_pars_vertex>
void main() {
	#include <batching_vertex>
	#include <beginnormal_vertex>
	#include <morphinstance_vertex>
	#include <morphnormal_vertex>
	#include <skinbase_vertex>
	#include <skinnormal_vertex>
	#include <defaultnormal_vertex>
	#include <begin_vertex>
	#include <morphtarget_vertex>
	#include <skinning_vertex>
	#include <project_vertex>
	#include <logdepthbuf_vertex>
	#include <worldpos_vertex>
	#include <shadowmap_vertex>
	#include <fog_vertex>
}`,Y1=`uniform vec3 color;
uniform float opacity;
#include <common>
#include <fog_pars_fragment>
#include <bsdfs>
#include <lights_pars_begin>
#include <logdepthbuf_pars_fragment>
#include <shadowmap_pars_fragment>
#include <shadowmask_pars_fragment>
void main() {
	#include <logdepthbuf_fragment>
	gl_FragColor = vec4( color, opacity * ( 1.0 - getShadowMask() ) );
	#include <tonemapping_fragment>
	#include <colorspace_fragment>
	#include <fog_fragment>
	#include <premultiplied_alpha_fragment>
}`,$1=`uniform float rotation;
uniform vec2 center;
#include <common>
#include <uv_pars_vertex>
#include <fog_pars_vertex>
#include <logdepthbuf_pars_vertex>
#include <clipping_planes_pars_vertex>
void main() {
	#include <uv_vertex>
	vec4 mvPosition = modelViewMatrix[ 3 ];
	vec2 scale = vec2( length( modelMatrix[ 0 ].xyz ), length( modelMatrix[ 1 ].xyz ) );
	#ifndef USE_SIZEATTENUATION
		bool isPerspective = isPerspectiveMatrix( projectionMatrix );
		if ( isPerspective ) scale *= - mvPosition.z;
	#endif
	vec2 alignedPosition = ( position.xy - ( center - vec2( 0.5 ) ) ) * scale;
	vec2 rotatedPosition;
	rotatedPosition.x = cos( rotation ) * alignedPosition.x - sin( rotation ) * alignedPosition.y;
	rotatedPosition.y = sin( rotation ) * alignedPosition.x + cos( rotation ) * alignedPosition.y;
	mvPosition.xy += rotatedPosition;
	gl_Position = projectionMatrix * mvPosition;
	#include <logdepthbuf_vertex>
	#include <clipping_planes_vertex>
	#include <fog_vertex>
}`,J1=`uniform vec3 diffuse;
uniform float opacity;
#include <common>
#include <uv_pars_fragment>
#include <map_pars_fragment>
#include <alphamap_pars_fragment>
#include <alphatest_pars_fragment>
#include <alphahash_pars_fragment>
#include <fog_pars_fragment>
#include <logdepthbuf_pars_fragment>
#include <clipping_planes_pars_fragment>
void main() {
	vec4 diffuseColor = vec4( diffuse, opacity );
	#include <clipping_planes_fragment>
	vec3 outgoingLight = vec3( 0.0 );
	#include <logdepthbuf_fragment>
	#include <map_fragment>
	#include <alphamap_fragment>
	#include <alphatest_fragment>
	#include <alphahash_fragment>
	outgoingLight = diffuseColor.rgb;
	#include <opaque_fragment>
	#include <tonemapping_fragment>
	#include <colorspace_fragment>
	#include <fog_fragment>
}`,me={alphahash_fragment:_A,alphahash_pars_fragment:xA,alphamap_fragment:vA,alphamap_pars_fragment:bA,alphatest_fragment:SA,alphatest_pars_fragment:MA,aomap_fragment:wA,aomap_pars_fragment:TA,batching_pars_vertex:AA,batching_vertex:EA,begin_vertex:CA,beginnormal_vertex:RA,bsdfs:PA,iridescence_fragment:LA,bumpmap_pars_fragment:IA,clipping_planes_fragment:NA,clipping_planes_pars_fragment:DA,clipping_planes_pars_vertex:OA,clipping_planes_vertex:FA,color_fragment:UA,color_pars_fragment:BA,color_pars_vertex:kA,color_vertex:zA,common:VA,defaultnormal_vertex:GA,displacementmap_pars_vertex:HA,displacementmap_vertex:WA,emissivemap_fragment:XA,emissivemap_pars_fragment:qA,colorspace_fragment:jA,colorspace_pars_fragment:YA,envmap_fragment:$A,envmap_common_pars_fragment:JA,envmap_pars_fragment:KA,envmap_pars_vertex:ZA,envmap_physical_pars_fragment:cE,envmap_vertex:QA,fog_vertex:tE,fog_pars_vertex:eE,fog_fragment:nE,fog_pars_fragment:iE,gradientmap_pars_fragment:sE,lightmap_pars_fragment:rE,lights_lambert_fragment:oE,lights_lambert_pars_fragment:aE,lights_pars_begin:lE,lights_toon_fragment:hE,lights_toon_pars_fragment:uE,lights_phong_fragment:dE,lights_phong_pars_fragment:fE,lights_physical_fragment:pE,lights_physical_pars_fragment:mE,lights_fragment_begin:gE,lights_fragment_maps:yE,lights_fragment_end:_E,lightprobes_pars_fragment:xE,logdepthbuf_fragment:vE,logdepthbuf_pars_fragment:bE,logdepthbuf_pars_vertex:SE,logdepthbuf_vertex:ME,map_fragment:wE,map_pars_fragment:TE,map_particle_fragment:AE,map_particle_pars_fragment:EE,metalnessmap_fragment:CE,metalnessmap_pars_fragment:RE,morphinstance_vertex:PE,morphcolor_vertex:LE,morphnormal_vertex:IE,morphtarget_pars_vertex:NE,morphtarget_vertex:DE,normal_fragment_begin:OE,normal_fragment_maps:FE,normal_pars_fragment:UE,normal_pars_vertex:BE,normal_vertex:kE,normalmap_pars_fragment:zE,clearcoat_normal_fragment_begin:VE,clearcoat_normal_fragment_maps:GE,clearcoat_pars_fragment:HE,iridescence_pars_fragment:WE,opaque_fragment:XE,packing:qE,premultiplied_alpha_fragment:jE,project_vertex:YE,dithering_fragment:$E,dithering_pars_fragment:JE,roughnessmap_fragment:KE,roughnessmap_pars_fragment:ZE,shadowmap_pars_fragment:QE,shadowmap_pars_vertex:t1,shadowmap_vertex:e1,shadowmask_pars_fragment:n1,skinbase_vertex:i1,skinning_pars_vertex:s1,skinning_vertex:r1,skinnormal_vertex:o1,specularmap_fragment:a1,specularmap_pars_fragment:l1,tonemapping_fragment:c1,tonemapping_pars_fragment:h1,transmission_fragment:u1,transmission_pars_fragment:d1,uv_pars_fragment:f1,uv_pars_vertex:p1,uv_vertex:m1,worldpos_vertex:g1,background_vert:y1,background_frag:_1,backgroundCube_vert:x1,backgroundCube_frag:v1,cube_vert:b1,cube_frag:S1,depth_vert:M1,depth_frag:w1,distance_vert:T1,distance_frag:A1,equirect_vert:E1,equirect_frag:C1,linedashed_vert:R1,linedashed_frag:P1,meshbasic_vert:L1,meshbasic_frag:I1,meshlambert_vert:N1,meshlambert_frag:D1,meshmatcap_vert:O1,meshmatcap_frag:F1,meshnormal_vert:U1,meshnormal_frag:B1,meshphong_vert:k1,meshphong_frag:z1,meshphysical_vert:V1,meshphysical_frag:G1,meshtoon_vert:H1,meshtoon_frag:W1,points_vert:X1,points_frag:q1,shadow_vert:j1,shadow_frag:Y1,sprite_vert:$1,sprite_frag:J1},Lt={common:{diffuse:{value:new Rt(16777215)},opacity:{value:1},map:{value:null},mapTransform:{value:new se},alphaMap:{value:null},alphaMapTransform:{value:new se},alphaTest:{value:0}},specularmap:{specularMap:{value:null},specularMapTransform:{value:new se}},envmap:{envMap:{value:null},envMapRotation:{value:new se},reflectivity:{value:1},ior:{value:1.5},refractionRatio:{value:.98},dfgLUT:{value:null}},aomap:{aoMap:{value:null},aoMapIntensity:{value:1},aoMapTransform:{value:new se}},lightmap:{lightMap:{value:null},lightMapIntensity:{value:1},lightMapTransform:{value:new se}},bumpmap:{bumpMap:{value:null},bumpMapTransform:{value:new se},bumpScale:{value:1}},normalmap:{normalMap:{value:null},normalMapTransform:{value:new se},normalScale:{value:new Xt(1,1)}},displacementmap:{displacementMap:{value:null},displacementMapTransform:{value:new se},displacementScale:{value:1},displacementBias:{value:0}},emissivemap:{emissiveMap:{value:null},emissiveMapTransform:{value:new se}},metalnessmap:{metalnessMap:{value:null},metalnessMapTransform:{value:new se}},roughnessmap:{roughnessMap:{value:null},roughnessMapTransform:{value:new se}},gradientmap:{gradientMap:{value:null}},fog:{fogDensity:{value:25e-5},fogNear:{value:1},fogFar:{value:2e3},fogColor:{value:new Rt(16777215)}},lights:{ambientLightColor:{value:[]},lightProbe:{value:[]},sunLights:{value:[],properties:{direction:{},color:{}}},sunLightShadows:{value:[],properties:{shadowIntensity:1,shadowBias:{},shadowNormalBias:{},shadowRadius:{},shadowMapSize:{}}},sunShadowMatrix:{value:[]},sunShadowCascade:{value:[]},directionalLights:{value:[],properties:{direction:{},color:{}}},directionalLightShadows:{value:[],properties:{shadowIntensity:1,shadowBias:{},shadowNormalBias:{},shadowRadius:{},shadowMapSize:{}}},directionalShadowMatrix:{value:[]},spotLights:{value:[],properties:{color:{},position:{},direction:{},distance:{},coneCos:{},penumbraCos:{},decay:{}}},spotLightShadows:{value:[],properties:{shadowIntensity:1,shadowBias:{},shadowNormalBias:{},shadowRadius:{},shadowMapSize:{}}},spotLightMap:{value:[]},spotLightMatrix:{value:[]},pointLights:{value:[],properties:{color:{},position:{},decay:{},distance:{}}},pointLightShadows:{value:[],properties:{shadowIntensity:1,shadowBias:{},shadowNormalBias:{},shadowRadius:{},shadowMapSize:{},shadowCameraNear:{},shadowCameraFar:{}}},pointShadowMatrix:{value:[]},hemisphereLights:{value:[],properties:{direction:{},skyColor:{},groundColor:{}}},rectAreaLights:{value:[],properties:{color:{},position:{},width:{},height:{}}},ltc_1:{value:null},ltc_2:{value:null},probesSH:{value:[]},probesMin:{value:[]},probesMax:{value:[]},probesResolution:{value:[]}},points:{diffuse:{value:new Rt(16777215)},opacity:{value:1},size:{value:1},scale:{value:1},map:{value:null},alphaMap:{value:null},alphaMapTransform:{value:new se},alphaTest:{value:0},uvTransform:{value:new se}},sprite:{diffuse:{value:new Rt(16777215)},opacity:{value:1},center:{value:new Xt(.5,.5)},rotation:{value:0},map:{value:null},mapTransform:{value:new se},alphaMap:{value:null},alphaMapTransform:{value:new se},alphaTest:{value:0}}},_i={basic:{uniforms:si([Lt.common,Lt.specularmap,Lt.envmap,Lt.aomap,Lt.lightmap,Lt.fog]),vertexShader:me.meshbasic_vert,fragmentShader:me.meshbasic_frag},lambert:{uniforms:si([Lt.common,Lt.specularmap,Lt.envmap,Lt.aomap,Lt.lightmap,Lt.emissivemap,Lt.bumpmap,Lt.normalmap,Lt.displacementmap,Lt.fog,Lt.lights,{emissive:{value:new Rt(0)},envMapIntensity:{value:1}}]),vertexShader:me.meshlambert_vert,fragmentShader:me.meshlambert_frag},phong:{uniforms:si([Lt.common,Lt.specularmap,Lt.envmap,Lt.aomap,Lt.lightmap,Lt.emissivemap,Lt.bumpmap,Lt.normalmap,Lt.displacementmap,Lt.fog,Lt.lights,{emissive:{value:new Rt(0)},specular:{value:new Rt(1118481)},shininess:{value:30},envMapIntensity:{value:1}}]),vertexShader:me.meshphong_vert,fragmentShader:me.meshphong_frag},standard:{uniforms:si([Lt.common,Lt.envmap,Lt.aomap,Lt.lightmap,Lt.emissivemap,Lt.bumpmap,Lt.normalmap,Lt.displacementmap,Lt.roughnessmap,Lt.metalnessmap,Lt.fog,Lt.lights,{emissive:{value:new Rt(0)},roughness:{value:1},metalness:{value:0},envMapIntensity:{value:1}}]),vertexShader:me.meshphysical_vert,fragmentShader:me.meshphysical_frag},toon:{uniforms:si([Lt.common,Lt.aomap,Lt.lightmap,Lt.emissivemap,Lt.bumpmap,Lt.normalmap,Lt.displacementmap,Lt.gradientmap,Lt.fog,Lt.lights,{emissive:{value:new Rt(0)}}]),vertexShader:me.meshtoon_vert,fragmentShader:me.meshtoon_frag},matcap:{uniforms:si([Lt.common,Lt.bumpmap,Lt.normalmap,Lt.displacementmap,Lt.fog,{matcap:{value:null}}]),vertexShader:me.meshmatcap_vert,fragmentShader:me.meshmatcap_frag},points:{uniforms:si([Lt.points,Lt.fog]),vertexShader:me.points_vert,fragmentShader:me.points_frag},dashed:{uniforms:si([Lt.common,Lt.fog,{scale:{value:1},dashSize:{value:1},totalSize:{value:2}}]),vertexShader:me.linedashed_vert,fragmentShader:me.linedashed_frag},depth:{uniforms:si([Lt.common,Lt.displacementmap]),vertexShader:me.depth_vert,fragmentShader:me.depth_frag},normal:{uniforms:si([Lt.common,Lt.bumpmap,Lt.normalmap,Lt.displacementmap,{opacity:{value:1}}]),vertexShader:me.meshnormal_vert,fragmentShader:me.meshnormal_frag},sprite:{uniforms:si([Lt.sprite,Lt.fog]),vertexShader:me.sprite_vert,fragmentShader:me.sprite_frag},background:{uniforms:{uvTransform:{value:new se},t2D:{value:null},backgroundIntensity:{value:1}},vertexShader:me.background_vert,fragmentShader:me.background_frag},backgroundCube:{uniforms:{envMap:{value:null},backgroundBlurriness:{value:0},backgroundIntensity:{value:1},backgroundRotation:{value:new se}},vertexShader:me.backgroundCube_vert,fragmentShader:me.backgroundCube_frag},cube:{uniforms:{tCube:{value:null},tFlip:{value:-1},opacity:{value:1}},vertexShader:me.cube_vert,fragmentShader:me.cube_frag},equirect:{uniforms:{tEquirect:{value:null}},vertexShader:me.equirect_vert,fragmentShader:me.equirect_frag},distance:{uniforms:si([Lt.common,Lt.displacementmap,{referencePosition:{value:new F},nearDistance:{value:1},farDistance:{value:1e3}}]),vertexShader:me.distance_vert,fragmentShader:me.distance_frag},shadow:{uniforms:si([Lt.lights,Lt.fog,{color:{value:new Rt(0)},opacity:{value:1}}]),vertexShader:me.shadow_vert,fragmentShader:me.shadow_frag}};_i.physical={uniforms:si([_i.standard.uniforms,{clearcoat:{value:0},clearcoatMap:{value:null},clearcoatMapTransform:{value:new se},clearcoatNormalMap:{value:null},clearcoatNormalMapTransform:{value:new se},clearcoatNormalScale:{value:new Xt(1,1)},clearcoatRoughness:{value:0},clearcoatRoughnessMap:{value:null},clearcoatRoughnessMapTransform:{value:new se},diffuseRoughness:{value:0},diffuseRoughnessMap:{value:null},diffuseRoughnessMapTransform:{value:new se},dispersion:{value:0},retroreflectivity:{value:0},iridescence:{value:0},iridescenceMap:{value:null},iridescenceMapTransform:{value:new se},iridescenceIOR:{value:1.3},iridescenceThicknessMinimum:{value:100},iridescenceThicknessMaximum:{value:400},iridescenceThicknessMap:{value:null},iridescenceThicknessMapTransform:{value:new se},sheen:{value:0},sheenColor:{value:new Rt(0)},sheenColorMap:{value:null},sheenColorMapTransform:{value:new se},sheenRoughness:{value:1},sheenRoughnessMap:{value:null},sheenRoughnessMapTransform:{value:new se},transmission:{value:0},transmissionMap:{value:null},transmissionMapTransform:{value:new se},transmissionSamplerSize:{value:new Xt},transmissionSamplerMap:{value:null},thickness:{value:0},thicknessMap:{value:null},thicknessMapTransform:{value:new se},attenuationDistance:{value:0},attenuationColor:{value:new Rt(0)},specularColor:{value:new Rt(1,1,1)},specularColorMap:{value:null},specularColorMapTransform:{value:new se},specularIntensity:{value:1},specularIntensityMap:{value:null},specularIntensityMapTransform:{value:new se},anisotropyVector:{value:new Xt},anisotropyMap:{value:null},anisotropyMapTransform:{value:new se}}]),vertexShader:me.meshphysical_vert,fragmentShader:me.meshphysical_frag};var sd={r:0,b:0,g:0},K1=new Nt,tv=new se;tv.set(-1,0,0,0,1,0,0,0,1);function Z1(s,t,e,n,i,r){let o=new Rt(0),a=i===!0?0:1,l,c,h=null,u=0,d=null;function f(_){let w=_.isScene===!0?_.background:null;if(w&&w.isTexture){let v=_.backgroundBlurriness>0;w=t.get(w,v)}return w}function m(_){let w=!1,v=f(_);v===null?p(o,a):v&&v.isColor&&(p(v,1),w=!0);let A=s.xr.getEnvironmentBlendMode();A==="additive"?e.buffers.color.setClear(0,0,0,1,r):A==="alpha-blend"&&e.buffers.color.setClear(0,0,0,0,r),(s.autoClear||w)&&(e.buffers.depth.setTest(!0),e.buffers.depth.setMask(!0),e.buffers.color.setMask(!0),s.clear(s.autoClearColor,s.autoClearDepth,s.autoClearStencil))}function y(_,w){let v=f(w);v&&v.isCubeTexture?(c===void 0&&(c=new de(new Ms(1,1,1),new vi({name:"BackgroundCubeMaterial",uniforms:vo(_i.backgroundCube.uniforms),vertexShader:_i.backgroundCube.vertexShader,fragmentShader:_i.backgroundCube.fragmentShader,side:jn,depthTest:!1,depthWrite:!1,fog:!1,allowOverride:!1})),c.geometry.deleteAttribute("normal"),c.geometry.deleteAttribute("uv"),c.onBeforeRender=function(A,S,x){this.matrixWorld.copyPosition(x.matrixWorld)},Object.defineProperty(c.material,"envMap",{get:function(){return this.uniforms.envMap.value}}),n.update(c)),c.material.uniforms.envMap.value=v,c.material.uniforms.backgroundBlurriness.value=w.backgroundBlurriness,c.material.uniforms.backgroundIntensity.value=w.backgroundIntensity,c.material.uniforms.backgroundRotation.value.setFromMatrix4(K1.makeRotationFromEuler(w.backgroundRotation)).transpose(),v.isRenderTargetTexture===!1&&c.material.uniforms.backgroundRotation.value.premultiply(tv),c.material.toneMapped=ue.getTransfer(v.colorSpace)!==Ne,(h!==v||u!==v.version||d!==s.toneMapping)&&(c.material.needsUpdate=!0,h=v,u=v.version,d=s.toneMapping),c.layers.enableAll(),_.unshift(c,c.geometry,c.material,0,0,null)):v&&v.isTexture&&(l===void 0&&(l=new de(new hs(2,2),new vi({name:"BackgroundMaterial",uniforms:vo(_i.background.uniforms),vertexShader:_i.background.vertexShader,fragmentShader:_i.background.fragmentShader,side:Es,depthTest:!1,depthWrite:!1,fog:!1,allowOverride:!1})),l.geometry.deleteAttribute("normal"),Object.defineProperty(l.material,"map",{get:function(){return this.uniforms.t2D.value}}),n.update(l)),l.material.uniforms.t2D.value=v,l.material.uniforms.backgroundIntensity.value=w.backgroundIntensity,l.material.toneMapped=ue.getTransfer(v.colorSpace)!==Ne,v.matrixAutoUpdate===!0&&v.updateMatrix(),l.material.uniforms.uvTransform.value.copy(v.matrix),(h!==v||u!==v.version||d!==s.toneMapping)&&(l.material.needsUpdate=!0,h=v,u=v.version,d=s.toneMapping),l.layers.enableAll(),_.unshift(l,l.geometry,l.material,0,0,null))}function p(_,w){_.getRGB(sd,wm(s)),e.buffers.color.setClear(sd.r,sd.g,sd.b,w,r)}function g(){c!==void 0&&(c.geometry.dispose(),c.material.dispose(),c=void 0),l!==void 0&&(l.geometry.dispose(),l.material.dispose(),l=void 0)}return{getClearColor:function(){return o},setClearColor:function(_,w=1){o.set(_),a=w,p(o,a)},getClearAlpha:function(){return a},setClearAlpha:function(_){a=_,p(o,a)},render:m,addToRenderList:y,dispose:g}}function Q1(s,t){let e=s.getParameter(s.MAX_VERTEX_ATTRIBS),n={},i=d(null),r=i,o=!1;function a(R,O,k,N,W){let z=!1,H=u(R,N,k,O);r!==H&&(r=H,c(r.object)),z=f(R,N,k,W),z&&m(R,N,k,W),W!==null&&t.update(W,s.ELEMENT_ARRAY_BUFFER),(z||o)&&(o=!1,v(R,O,k,N),W!==null&&s.bindBuffer(s.ELEMENT_ARRAY_BUFFER,t.get(W).buffer))}function l(){return s.createVertexArray()}function c(R){return s.bindVertexArray(R)}function h(R){return s.deleteVertexArray(R)}function u(R,O,k,N){let W=N.wireframe===!0,z=n[O.id];z===void 0&&(z={},n[O.id]=z);let H=R.isInstancedMesh===!0?R.id:0,it=z[H];it===void 0&&(it={},z[H]=it);let Y=it[k.id];Y===void 0&&(Y={},it[k.id]=Y);let K=Y[W];return K===void 0&&(K=d(l()),Y[W]=K),K}function d(R){let O=[],k=[],N=[];for(let W=0;W<e;W++)O[W]=0,k[W]=0,N[W]=0;return{geometry:null,program:null,wireframe:!1,newAttributes:O,enabledAttributes:k,attributeDivisors:N,object:R,attributes:{},index:null}}function f(R,O,k,N){let W=r.attributes,z=O.attributes,H=0,it=k.getAttributes();for(let Y in it)if(it[Y].location>=0){let tt=W[Y],ht=z[Y];if(ht===void 0&&(Y==="instanceMatrix"&&R.instanceMatrix&&(ht=R.instanceMatrix),Y==="instanceColor"&&R.instanceColor&&(ht=R.instanceColor)),tt===void 0||tt.attribute!==ht||ht&&tt.data!==ht.data)return!0;H++}return r.attributesNum!==H||r.index!==N}function m(R,O,k,N){let W={},z=O.attributes,H=0,it=k.getAttributes();for(let Y in it)if(it[Y].location>=0){let tt=z[Y];tt===void 0&&(Y==="instanceMatrix"&&R.instanceMatrix&&(tt=R.instanceMatrix),Y==="instanceColor"&&R.instanceColor&&(tt=R.instanceColor));let ht={};ht.attribute=tt,tt&&tt.data&&(ht.data=tt.data),W[Y]=ht,H++}r.attributes=W,r.attributesNum=H,r.index=N}function y(){let R=r.newAttributes;for(let O=0,k=R.length;O<k;O++)R[O]=0}function p(R){g(R,0)}function g(R,O){let k=r.newAttributes,N=r.enabledAttributes,W=r.attributeDivisors;k[R]=1,N[R]===0&&(s.enableVertexAttribArray(R),N[R]=1),W[R]!==O&&(s.vertexAttribDivisor(R,O),W[R]=O)}function _(){let R=r.newAttributes,O=r.enabledAttributes;for(let k=0,N=O.length;k<N;k++)O[k]!==R[k]&&(s.disableVertexAttribArray(k),O[k]=0)}function w(R,O,k,N,W,z,H){H===!0?s.vertexAttribIPointer(R,O,k,W,z):s.vertexAttribPointer(R,O,k,N,W,z)}function v(R,O,k,N){y();let W=N.attributes,z=k.getAttributes(),H=O.defaultAttributeValues;for(let it in z){let Y=z[it];if(Y.location>=0){let K=W[it];if(K===void 0&&(it==="instanceMatrix"&&R.instanceMatrix&&(K=R.instanceMatrix),it==="instanceColor"&&R.instanceColor&&(K=R.instanceColor)),K!==void 0){let tt=K.normalized,ht=K.itemSize,st=t.get(K);if(st===void 0)continue;let j=st.buffer,rt=st.type,nt=st.bytesPerElement,lt=rt===s.INT||rt===s.UNSIGNED_INT||K.gpuType===xu;if(K.isInterleavedBufferAttribute){let gt=K.data,Ut=gt.isInterleavedBuffer===!0?gt.stride:gt.itemSize,Kt=K.offset;if(gt.isInstancedInterleavedBuffer||gt.isInstancedBufferAttribute){for(let zt=0;zt<Y.locationSize;zt++)g(Y.location+zt,gt.meshPerAttribute);R.isInstancedMesh!==!0&&N._maxInstanceCount===void 0&&(N._maxInstanceCount=gt.meshPerAttribute*gt.count)}else for(let zt=0;zt<Y.locationSize;zt++)p(Y.location+zt);s.bindBuffer(s.ARRAY_BUFFER,j);for(let zt=0;zt<Y.locationSize;zt++)w(Y.location+zt,ht/Y.locationSize,rt,tt,Ut*nt,(Kt+ht/Y.locationSize*zt)*nt,lt)}else{if(K.isInstancedBufferAttribute){for(let gt=0;gt<Y.locationSize;gt++)g(Y.location+gt,K.meshPerAttribute);R.isInstancedMesh!==!0&&N._maxInstanceCount===void 0&&(N._maxInstanceCount=K.meshPerAttribute*K.count)}else for(let gt=0;gt<Y.locationSize;gt++)p(Y.location+gt);s.bindBuffer(s.ARRAY_BUFFER,j);for(let gt=0;gt<Y.locationSize;gt++)w(Y.location+gt,ht/Y.locationSize,rt,tt,ht*nt,ht/Y.locationSize*gt*nt,lt)}}else if(H!==void 0){let tt=H[it];if(tt!==void 0)switch(tt.length){case 2:s.vertexAttrib2fv(Y.location,tt);break;case 3:s.vertexAttrib3fv(Y.location,tt);break;case 4:s.vertexAttrib4fv(Y.location,tt);break;default:s.vertexAttrib1fv(Y.location,tt)}}}}_()}function A(){L();for(let R in n){let O=n[R];for(let k in O){let N=O[k];for(let W in N){let z=N[W];for(let H in z)h(z[H].object),delete z[H];delete N[W]}}delete n[R]}}function S(R){if(n[R.id]===void 0)return;let O=n[R.id];for(let k in O){let N=O[k];for(let W in N){let z=N[W];for(let H in z)h(z[H].object),delete z[H];delete N[W]}}delete n[R.id]}function x(R){for(let O in n){let k=n[O];for(let N in k){let W=k[N];if(W[R.id]===void 0)continue;let z=W[R.id];for(let H in z)h(z[H].object),delete z[H];delete W[R.id]}}}function M(R){for(let O in n){let k=n[O],N=R.isInstancedMesh===!0?R.id:0,W=k[N];if(W!==void 0){for(let z in W){let H=W[z];for(let it in H)h(H[it].object),delete H[it];delete W[z]}delete k[N],Object.keys(k).length===0&&delete n[O]}}}function L(){P(),o=!0,r!==i&&(r=i,c(r.object))}function P(){i.geometry=null,i.program=null,i.wireframe=!1}return{setup:a,reset:L,resetDefaultState:P,dispose:A,releaseStatesOfGeometry:S,releaseStatesOfObject:M,releaseStatesOfProgram:x,initAttributes:y,enableAttribute:p,disableUnusedAttributes:_}}function tC(s,t,e){let n;function i(l){n=l}function r(l,c){s.drawArrays(n,l,c),e.update(c,n,1)}function o(l,c,h){h!==0&&(s.drawArraysInstanced(n,l,c,h),e.update(c,n,h))}function a(l,c,h){if(h===0)return;t.get("WEBGL_multi_draw").multiDrawArraysWEBGL(n,l,0,c,0,h);let d=0;for(let f=0;f<h;f++)d+=c[f];e.update(d,n,1)}this.setMode=i,this.render=r,this.renderInstances=o,this.renderMultiDraw=a}function eC(s,t,e,n){let i;function r(){if(i!==void 0)return i;if(t.has("EXT_texture_filter_anisotropic")===!0){let x=t.get("EXT_texture_filter_anisotropic");i=s.getParameter(x.MAX_TEXTURE_MAX_ANISOTROPY_EXT)}else i=0;return i}function o(x){return!(x!==Ji&&n.convert(x)!==s.getParameter(s.IMPLEMENTATION_COLOR_READ_FORMAT))}function a(x){let M=x===ds&&(t.has("EXT_color_buffer_half_float")||t.has("EXT_color_buffer_float"));return!(x!==Si&&x!==ki&&!M&&n.convert(x)!==s.getParameter(s.IMPLEMENTATION_COLOR_READ_TYPE))}function l(x){if(x==="highp"){if(s.getShaderPrecisionFormat(s.VERTEX_SHADER,s.HIGH_FLOAT).precision>0&&s.getShaderPrecisionFormat(s.FRAGMENT_SHADER,s.HIGH_FLOAT).precision>0)return"highp";x="mediump"}return x==="mediump"&&s.getShaderPrecisionFormat(s.VERTEX_SHADER,s.MEDIUM_FLOAT).precision>0&&s.getShaderPrecisionFormat(s.FRAGMENT_SHADER,s.MEDIUM_FLOAT).precision>0?"mediump":"lowp"}let c=e.precision!==void 0?e.precision:"highp",h=l(c);h!==c&&(Yt("WebGLRenderer:",c,"not supported, using",h,"instead."),c=h);let u=e.reversedDepthBuffer===!0&&t.has("EXT_clip_control"),d=e.logarithmicDepthBuffer===!0&&u===!1;e.reversedDepthBuffer===!0&&u===!1&&Yt("WebGLRenderer: Unable to use reversed depth buffer due to missing EXT_clip_control extension. Fallback to default depth buffer."),e.logarithmicDepthBuffer===!0&&u===!0&&Yt("WebGLRenderer: Logarithmic depth buffer is ignored when reversed depth buffer is enabled.");let f=s.getParameter(s.MAX_TEXTURE_IMAGE_UNITS),m=s.getParameter(s.MAX_VERTEX_TEXTURE_IMAGE_UNITS),y=s.getParameter(s.MAX_TEXTURE_SIZE),p=s.getParameter(s.MAX_CUBE_MAP_TEXTURE_SIZE),g=s.getParameter(s.MAX_VERTEX_ATTRIBS),_=s.getParameter(s.MAX_VERTEX_UNIFORM_VECTORS),w=s.getParameter(s.MAX_VARYING_VECTORS),v=s.getParameter(s.MAX_FRAGMENT_UNIFORM_VECTORS),A=s.getParameter(s.MAX_SAMPLES),S=s.getParameter(s.SAMPLES);return{isWebGL2:!0,getMaxAnisotropy:r,getMaxPrecision:l,textureFormatReadable:o,textureTypeReadable:a,precision:c,logarithmicDepthBuffer:d,reversedDepthBuffer:u,maxTextures:f,maxVertexTextures:m,maxTextureSize:y,maxCubemapSize:p,maxAttributes:g,maxVertexUniforms:_,maxVaryings:w,maxFragmentUniforms:v,maxSamples:A,samples:S}}function nC(s){let t=this,e=null,n=0,i=!1,r=!1,o=new Oi,a=new se,l={value:null,needsUpdate:!1};this.uniform=l,this.numPlanes=0,this.numIntersection=0,this.init=function(u,d){let f=u.length!==0||d||n!==0||i;return i=d,n=u.length,f},this.beginShadows=function(){r=!0,h(null)},this.endShadows=function(){r=!1},this.setGlobalState=function(u,d){e=h(u,d,0)},this.setState=function(u,d,f){let m=u.clippingPlanes,y=u.clipIntersection,p=u.clipShadows,g=s.get(u);if(!i||m===null||m.length===0||r&&!p)r?h(null):c();else{let _=r?0:n,w=_*4,v=g.clippingState||null;l.value=v,v=h(m,d,w,f);for(let A=0;A!==w;++A)v[A]=e[A];g.clippingState=v,this.numIntersection=y?this.numPlanes:0,this.numPlanes+=_}};function c(){l.value!==e&&(l.value=e,l.needsUpdate=n>0),t.numPlanes=n,t.numIntersection=0}function h(u,d,f,m){let y=u!==null?u.length:0,p=null;if(y!==0){if(p=l.value,m!==!0||p===null){let g=f+y*4,_=d.matrixWorldInverse;a.getNormalMatrix(_),(p===null||p.length<g)&&(p=new Float32Array(g));for(let w=0,v=f;w!==y;++w,v+=4)o.copy(u[w]).applyMatrix4(_,a),o.normal.toArray(p,v),p[v+3]=o.constant}l.value=p,l.needsUpdate=!0}return t.numPlanes=y,t.numIntersection=0,p}}var ac=class extends Fi{constructor(t=1,e={}){super(t,t,e),this.isWebGLCubeRenderTarget=!0;let n={width:t,height:t,depth:1},i=[n,n,n,n,n,n];this.texture=new Rl(i),this._setTextureOptions(e),this.texture.isRenderTargetTexture=!0}fromEquirectangularTexture(t,e){this.texture.type=e.type,this.texture.colorSpace=e.colorSpace,this.texture.generateMipmaps=e.generateMipmaps,this.texture.minFilter=e.minFilter,this.texture.magFilter=e.magFilter;let n={uniforms:{tEquirect:{value:null}},vertexShader:`

				varying vec3 vWorldDirection;

				vec3 transformDirection( in vec3 dir, in mat4 matrix ) {

					return normalize( ( matrix * vec4( dir, 0.0 ) ).xyz );

				}

				void main() {

					vWorldDirection = transformDirection( position, modelMatrix );

					#include <begin_vertex>
					#include <project_vertex>

				}
			`,fragmentShader:`

				uniform sampler2D tEquirect;

				varying vec3 vWorldDirection;

				#include <common>

				void main() {

					vec3 direction = normalize( vWorldDirection );

					vec2 sampleUV = equirectUv( direction );

					gl_FragColor = texture2D( tEquirect, sampleUV );

				}
			`},i=new Ms(5,5,5),r=new vi({name:"CubemapFromEquirect",uniforms:vo(n.uniforms),vertexShader:n.vertexShader,fragmentShader:n.fragmentShader,side:jn,blending:go});r.uniforms.tEquirect.value=e;let o=new de(i,r),a=e.minFilter;return e.minFilter===$i&&(e.minFilter=Bn),new wa(1,10,this).update(t,o),e.minFilter=a,o.geometry.dispose(),o.material.dispose(),this}clear(t,e=!0,n=!0,i=!0){let r=t.getRenderTarget();for(let o=0;o<6;o++)t.setRenderTarget(this,o),t.clear(e,n,i);t.setRenderTarget(r)}},Ix=256,iC=3,sC=20,ev=256,nv=16,rC=3,oC=new F,aC=new Rt,od=class s{constructor(t){this._renderer=t,this._cubeSize=0,this._sourceTarget=null,this._cubeCamera=new wa(1,10,null),this._boxMesh=new de(new Ms(5,5,5),null),this._cubemapMaterial=null,this._equirectMaterial=null,this._blurMaterial=null,this._ggxMaterial=null,this._integrationMaterial=null}fromScene(t,e=0,n=.1,i=100,r={}){let{size:o=256,position:a=oC}=r,l=this._renderer;this._setSize(o);let c=this._allocateTarget(),h=this._getSourceTarget(!0);e>0&&(h.texture.mipmapsAutoUpdate=!1);let u=l.autoClear,d=l.autoClearColor,f=l.autoClearDepth,m=l.autoClearStencil,y=t.background;l.autoClear=!0,l.autoClearColor=!0,l.autoClearDepth=!0,l.autoClearStencil=!0,y===null&&(t.background=l.getClearColor(aC));let p=new wa(n,i,h);return p.position.copy(a),p.update(l,t),l.autoClear=u,l.autoClearColor=d,l.autoClearDepth=f,l.autoClearStencil=m,t.background=y,e>0&&(h.texture.mipmapsAutoUpdate=!0,this._blur(c,e)),this._applyPMREM(c),c}fromEquirectangular(t,e=null){return this._fromTexture(t,e)}fromCubemap(t,e=null){return this._fromTexture(t,e)}compileCubemapShader(){this._cubemapMaterial===null&&(this._cubemapMaterial=Ox(),this._compileMaterial(this._cubemapMaterial))}compileEquirectangularShader(){this._equirectMaterial===null&&(this._equirectMaterial=Dx(),this._compileMaterial(this._equirectMaterial))}dispose(){this._sourceTarget!==null&&this._sourceTarget.dispose(),this._cubemapMaterial!==null&&this._cubemapMaterial.dispose(),this._equirectMaterial!==null&&this._equirectMaterial.dispose(),this._blurMaterial!==null&&this._blurMaterial.dispose(),this._ggxMaterial!==null&&this._ggxMaterial.dispose(),this._integrationMaterial!==null&&this._integrationMaterial.dispose(),this._boxMesh.geometry.dispose()}static lodToRoughness(t,e){return e>0?1-Math.sqrt(1-t/e):0}_setSize(t){this._cubeSize=Math.max(Ix,bm(t))}_fromTexture(t,e){t.mapping===_o||t.mapping===Ca?this._setSize(t.image.length===0?Ix:t.image[0].width||t.image[0].image.width):this._setSize(t.image.width/4);let n=e||this._allocateTarget();return this._textureToCubemap(t),this._applyPMREM(n),n}_allocateTarget(){let t=this._cubeSize,e=Nx(t,!1,!1),n=Math.log2(t)-iC;for(let i=0;i<=n;i++)e.texture.mipmaps.push({width:t>>i,height:t>>i});return e.texture.name="PMREM",e.texture.isPMREMTexture=!0,e}_getSourceTarget(t=!1){let e=this._cubeSize,n=this._sourceTarget;return(n===null||n.width!==e||t&&n.depthBuffer===!1)&&(n!==null&&n.dispose(),this._sourceTarget=Nx(e,!0,t)),this._sourceTarget}_compileMaterial(t){this._boxMesh.material=t,this._renderer.compile(this._boxMesh,this._cubeCamera.children[0])}_renderCube(t,e,n){let i=this._boxMesh,r=this._cubeCamera;i.material=n,r.renderTarget=t,r.activeMipmapLevel=e;let o=t.width>>e;t.viewport.set(0,0,o,o),r.update(this._renderer,i),t.viewport.set(0,0,t.width,t.height)}_textureToCubemap(t){let e;t.mapping===_o||t.mapping===Ca?(this._cubemapMaterial===null&&(this._cubemapMaterial=Ox()),e=this._cubemapMaterial,e.uniforms.flipEnvMap.value=t.isRenderTargetTexture===!1?-1:1):(this._equirectMaterial===null&&(this._equirectMaterial=Dx()),e=this._equirectMaterial),e.uniforms.envMap.value=t,this._renderCube(this._getSourceTarget(),0,e)}_applyPMREM(t){this._ggxMaterial===null&&(this._ggxMaterial=lC(),this._integrationMaterial=cC());let e=this._cubeSize,n=t.texture.mipmaps.length-1,i=this._ggxMaterial.uniforms;i.envMap.value=this._sourceTarget.texture;let r=this._integrationMaterial.uniforms;r.envMap.value=this._sourceTarget.texture,r.sourceLod.value=Math.log2(e/nv);for(let o=0;o<=n;o++){let a=s.lodToRoughness(o,n);if(o>n-rC)r.roughness.value=a,this._renderCube(t,o,this._integrationMaterial);else{let l=a>0?Math.log2(e)+.5*Math.log2(6/(ev*Math.pow(a,4)))+.5:0;i.roughness.value=a,i.lodBias.value=l,this._renderCube(t,o,this._ggxMaterial)}}}_blur(t,e){this._blurMaterial===null&&(this._blurMaterial=hC());let n=this._blurMaterial,i=n.uniforms,r=this._sourceTarget;i.sigma.value=Math.min(e,Math.PI)/Math.SQRT2,i.envMap.value=r.texture,this._renderCube(t,0,n),i.envMap.value=t.texture,this._renderCube(r,0,n)}};function Nx(s,t,e){return new ac(s,{minFilter:$i,generateMipmaps:t,type:ds,colorSpace:_l,depthBuffer:e})}function lc(s,t,e){return new vi({name:s,uniforms:t,vertexShader:me.cube_vert,fragmentShader:e,side:jn,blending:go,depthTest:!1,depthWrite:!1})}function lC(){return lc("PMREMGGXConvolution",{envMap:{value:null},roughness:{value:0},lodBias:{value:0}},`

		#define GGX_SAMPLES ${ev}u

		varying vec3 vWorldDirection;

		uniform samplerCube envMap;
		uniform float roughness;
		uniform float lodBias;

		#include <common>

		// Van der Corput radical inverse
		float radicalInverse_VdC( uint bits ) {

			bits = ( bits << 16u ) | ( bits >> 16u );
			bits = ( ( bits & 0x55555555u ) << 1u ) | ( ( bits & 0xAAAAAAAAu ) >> 1u );
			bits = ( ( bits & 0x33333333u ) << 2u ) | ( ( bits & 0xCCCCCCCCu ) >> 2u );
			bits = ( ( bits & 0x0F0F0F0Fu ) << 4u ) | ( ( bits & 0xF0F0F0F0u ) >> 4u );
			bits = ( ( bits & 0x00FF00FFu ) << 8u ) | ( ( bits & 0xFF00FF00u ) >> 8u );
			return float( bits ) * 2.3283064365386963e-10; // / 0x100000000

		}

		// Hammersley sequence
		vec2 hammersley( uint i, uint N ) {

			return vec2( float( i ) / float( N ), radicalInverse_VdC( i ) );

		}

		void main() {

			vec3 N = normalize( vWorldDirection );

			// For very low roughness, just sample the environment directly
			if ( roughness < 0.001 ) {

				gl_FragColor = vec4( textureLod( envMap, N, 0.0 ).rgb, 1.0 );
				return;

			}

			float alpha = roughness * roughness;
			float alpha2 = alpha * alpha;

			// Tangent space basis for VNDF sampling
			vec3 up = abs( N.z ) < 0.999 ? vec3( 0.0, 0.0, 1.0 ) : vec3( 1.0, 0.0, 0.0 );
			vec3 tangent = normalize( cross( up, N ) );
			vec3 bitangent = cross( N, tangent );

			vec3 prefilteredColor = vec3( 0.0 );
			float totalWeight = 0.0;

			for ( uint i = 0u; i < GGX_SAMPLES; i ++ ) {

				vec2 Xi = hammersley( i, GGX_SAMPLES );

				// With V = N, sample the reflected direction directly.
				float invQ = 1.0 / ( 1.0 - Xi.x + alpha2 * Xi.x );
				float NdotL = ( 1.0 - Xi.x - alpha2 * Xi.x ) * invQ;

				if ( NdotL > 0.0 ) {

					float phi = 2.0 * PI * Xi.y;
					float sinTheta = 2.0 * alpha * sqrt( Xi.x * ( 1.0 - Xi.x ) ) * invQ;
					vec3 L = N * NdotL + ( tangent * cos( phi ) + bitangent * sin( phi ) ) * sinTheta;

					// Match the source mip to the sample's solid angle. The terms
					// independent of the sample are precomputed in lodBias.
					float d = alpha2 * invQ;
					float lod = max( log2( d ) + lodBias, 0.0 );

					// Weight by NdotL for the split-sum approximation
					prefilteredColor += textureLod( envMap, L, lod ).rgb * NdotL;
					totalWeight += NdotL;

				}

			}

			gl_FragColor = vec4( prefilteredColor / totalWeight, 1.0 );

		}
	`)}function cC(){return lc("PMREMGGXIntegration",{envMap:{value:null},roughness:{value:0},sourceLod:{value:0},sourceSize:{value:nv}},`

		varying vec3 vWorldDirection;

		uniform samplerCube envMap;
		uniform float roughness;
		uniform float sourceLod;
		uniform int sourceSize;

		void main() {

			vec3 N = normalize( vWorldDirection );

			float alpha = roughness * roughness;
			float alpha2 = alpha * alpha;

			float texelSize = 2.0 / float( sourceSize );

			vec3 prefilteredColor = vec3( 0.0 );
			float totalWeight = 0.0;

			// Pair opposite texels: only the one in N's hemisphere contributes.
			for ( int face = 0; face < 3; face ++ ) {

				for ( int y = 0; y < sourceSize; y ++ ) {

					for ( int x = 0; x < sourceSize; x ++ ) {

						vec2 uv = ( vec2( x, y ) + 0.5 ) * texelSize - 1.0;
						vec3 texelDirection = face == 0 ? vec3( 1.0, uv ) : ( face == 1 ? vec3( uv.x, 1.0, uv.y ) : vec3( uv, 1.0 ) );

						float invDistance = inversesqrt( 1.0 + dot( uv, uv ) );
						float NdotL = dot( N, texelDirection );
						texelDirection *= NdotL < 0.0 ? - 1.0 : 1.0;
						NdotL = abs( NdotL ) * invDistance;

						// With V = N, NdotH squared is ( 1 + NdotL ) / 2. Common factors
						// in the GGX distribution and texel solid angle cancel when normalized.
						float d = 1.0 + alpha2 + ( alpha2 - 1.0 ) * NdotL;
						float weight = NdotL * invDistance * invDistance * invDistance / ( d * d );

						prefilteredColor += textureLod( envMap, texelDirection, sourceLod ).rgb * weight;
						totalWeight += weight;

					}

				}

			}

			gl_FragColor = vec4( prefilteredColor / totalWeight, 1.0 );

		}
	`)}function hC(){return lc("PMREMSphericalGaussianBlur",{envMap:{value:null},sigma:{value:0}},`

		#define SAMPLES ${sC}
		#define GOLDEN_ANGLE 2.39996322973

		varying vec3 vWorldDirection;

		uniform samplerCube envMap;
		uniform float sigma;

		#include <common>

		void main() {

			vec3 outputDirection = normalize( vWorldDirection );

			vec3 up = abs( outputDirection.z ) < 0.999 ? vec3( 0.0, 0.0, 1.0 ) : vec3( 1.0, 0.0, 0.0 );
			vec3 tangent = normalize( cross( up, outputDirection ) );
			vec3 bitangent = cross( outputDirection, tangent );

			// Truncate the kernel at three standard deviations or at the antipode.
			float thetaMax = min( 3.0 * sigma, PI );
			float truncation = 1.0 - exp( - 0.5 * thetaMax * thetaMax / ( sigma * sigma ) );

			vec3 accumColor = vec3( 0.0 );
			float accumWeight = 0.0;

			for ( int i = 0; i < SAMPLES; i ++ ) {

				// Stratified inverse-CDF sampling of the Gaussian, placed on a golden-angle spiral.
				float stratum = ( float( i ) + 0.5 ) / float( SAMPLES );
				float theta = sigma * sqrt( - 2.0 * log( 1.0 - stratum * truncation ) );
				float phi = float( i ) * GOLDEN_ANGLE;

				vec3 offset = cos( phi ) * tangent + sin( phi ) * bitangent;
				vec3 sampleDirection = cos( theta ) * outputDirection + sin( theta ) * offset;

				// Correct the planar sample density to solid angle.
				float weight = sin( theta ) / theta;

				accumColor += weight * textureLod( envMap, sampleDirection, 0.0 ).rgb;
				accumWeight += weight;

			}

			gl_FragColor = vec4( accumColor / accumWeight, 1.0 );

		}
	`)}function Dx(){return lc("PMREMEquirectangularToCubemap",{envMap:{value:null}},`

		varying vec3 vWorldDirection;

		uniform sampler2D envMap;

		#include <common>

		void main() {

			// Average four subpixel samples to preserve small, bright features.
			vec3 direction = normalize( vWorldDirection );
			vec3 dx = dFdx( direction ) * 0.25;
			vec3 dy = dFdy( direction ) * 0.25;

			vec3 color = textureLod( envMap, equirectUv( normalize( direction - dx - dy ) ), 0.0 ).rgb;
			color += textureLod( envMap, equirectUv( normalize( direction + dx - dy ) ), 0.0 ).rgb;
			color += textureLod( envMap, equirectUv( normalize( direction - dx + dy ) ), 0.0 ).rgb;
			color += textureLod( envMap, equirectUv( normalize( direction + dx + dy ) ), 0.0 ).rgb;
			gl_FragColor = vec4( color * 0.25, 1.0 );

		}
	`)}function Ox(){return lc("PMREMCubemapToCubemap",{envMap:{value:null},flipEnvMap:{value:-1}},`

		varying vec3 vWorldDirection;

		uniform samplerCube envMap;
		uniform float flipEnvMap;

		void main() {

			gl_FragColor = vec4( textureCube( envMap, vec3( flipEnvMap * vWorldDirection.x, vWorldDirection.yz ) ).rgb, 1.0 );

		}
	`)}function uC(s){let t=new WeakMap,e=new WeakMap,n=null;function i(d,f=!1){return d==null?null:f?o(d):r(d)}function r(d){if(d&&d.isTexture){let f=d.mapping;if(f===gu||f===yu)if(t.has(d)){let m=t.get(d).texture;return a(m,d.mapping)}else{let m=d.image;if(m&&m.height>0){let y=new ac(m.height);return y.fromEquirectangularTexture(s,d),t.set(d,y),d.addEventListener("dispose",c),a(y.texture,d.mapping)}else return null}}return d}function o(d){if(d&&d.isTexture&&d.isPMREMTexture!==!0){let f=d.mapping,m=f===gu||f===yu,y=f===_o||f===Ca;if(m||y){let p=e.get(d),g=p!==void 0?p.texture.pmremVersion:0;if(d.isRenderTargetTexture&&d.pmremVersion!==g)return n===null&&(n=new od(s)),p=m?n.fromEquirectangular(d,p):n.fromCubemap(d,p),p.texture.pmremVersion=d.pmremVersion,e.set(d,p),p.texture;if(p!==void 0)return p.texture;{let _=d.image;return m&&_&&_.height>0||y&&_&&l(_)?(n===null&&(n=new od(s)),p=m?n.fromEquirectangular(d):n.fromCubemap(d),p.texture.pmremVersion=d.pmremVersion,e.set(d,p),d.addEventListener("dispose",h),p.texture):null}}}return d}function a(d,f){return f===gu?d.mapping=_o:f===yu&&(d.mapping=Ca),d}function l(d){let f=0,m=6;for(let y=0;y<m;y++)d[y]!==void 0&&f++;return f===m}function c(d){let f=d.target;f.removeEventListener("dispose",c);let m=t.get(f);m!==void 0&&(t.delete(f),m.dispose())}function h(d){let f=d.target;f.removeEventListener("dispose",h);let m=e.get(f);m!==void 0&&(e.delete(f),m.dispose())}function u(){t=new WeakMap,e=new WeakMap,n!==null&&(n.dispose(),n=null)}return{get:i,dispose:u}}function dC(s){let t={};function e(n){if(t[n]!==void 0)return t[n];let i=s.getExtension(n);return t[n]=i,i}return{has:function(n){return e(n)!==null},init:function(){e("EXT_color_buffer_float"),e("WEBGL_clip_cull_distance"),e("OES_texture_float_linear"),e("EXT_color_buffer_half_float"),e("WEBGL_multisampled_render_to_texture"),e("WEBGL_render_shared_exponent")},get:function(n){let i=e(n);return i===null&&ml("WebGLRenderer: "+n+" extension not supported."),i}}}function fC(s,t,e,n){let i={},r=new WeakMap,o=new FinalizationRegistry(m=>delete i[m]);function a(m){l(m.target)}function l(m){m.index!==null&&t.remove(m.index);for(let p in m.attributes)t.remove(m.attributes[p]);m.removeEventListener("dispose",a),delete i[m.id],o.unregister(m);let y=r.get(m);y&&(t.remove(y),r.delete(m)),n.releaseStatesOfGeometry(m),m.isInstancedBufferGeometry===!0&&delete m._maxInstanceCount,e.memory.geometries--}function c(m,y){return i[y.id]!==void 0||(y.addEventListener("dispose",a),i[y.id]=new WeakRef(y),o.register(y,y.id,y),e.memory.geometries++),y}function h(m){let y=m.attributes;for(let p in y)t.update(y[p],s.ARRAY_BUFFER)}function u(m){let y=m.index,p=m.attributes.position,g=0;if(p===void 0)return;let _=y!==null?y.array.length:p.array.length/3-1,w=p.count>=65535?wl:Ml,v=new w(Math.ceil(_/3)*6,1),A=v.array;if(y!==null){let x=y.array;g=y.version;for(let M=0,L=0;M<_;M+=3){let P=x[M+0],R=x[M+1],O=x[M+2];A[L++]=P,A[L++]=R,A[L++]=R,A[L++]=O,A[L++]=O,A[L++]=P}}else{g=p.version;for(let x=0,M=0;x<_;x+=3){let L=x+0,P=x+1,R=x+2;A[M++]=L,A[M++]=P,A[M++]=P,A[M++]=R,A[M++]=R,A[M++]=L}}v.version=g;let S=r.get(m);S&&t.remove(S),r.set(m,v)}function d(m){let y=r.get(m);if(y){let p=m.index;p!==null&&y.version<p.version&&u(m)}else u(m);return r.get(m)}function f(){for(let m in i){let y=i[m].deref();y!==void 0&&l(y)}}return{get:c,update:h,getWireframeAttribute:d,dispose:f}}function pC(s,t,e){let n;function i(u){n=u}let r,o;function a(u){r=u.type,o=u.bytesPerElement}function l(u,d){s.drawElements(n,d,r,u*o),e.update(d,n,1)}function c(u,d,f){f!==0&&(s.drawElementsInstanced(n,d,r,u*o,f),e.update(d,n,f))}function h(u,d,f){if(f===0)return;t.get("WEBGL_multi_draw").multiDrawElementsWEBGL(n,d,0,r,u,0,f);let y=0;for(let p=0;p<f;p++)y+=d[p];e.update(y,n,1)}this.setMode=i,this.setIndex=a,this.render=l,this.renderInstances=c,this.renderMultiDraw=h}function mC(s){let t={geometries:0,textures:0},e={frame:0,calls:0,triangles:0,points:0,lines:0};function n(r,o,a){switch(e.calls++,o){case s.TRIANGLES:e.triangles+=a*(r/3);break;case s.LINES:e.lines+=a*(r/2);break;case s.LINE_STRIP:e.lines+=a*(r-1);break;case s.LINE_LOOP:e.lines+=a*r;break;case s.POINTS:e.points+=a*r;break;default:te("WebGLInfo: Unknown draw mode:",o);break}}function i(){e.calls=0,e.triangles=0,e.points=0,e.lines=0}return{memory:t,render:e,programs:null,autoReset:!0,reset:i,update:n}}function gC(s,t,e){let n=new WeakMap,i=new Se;function r(o,a,l){let c=o.morphTargetInfluences,h=a.morphAttributes.position||a.morphAttributes.normal||a.morphAttributes.color,u=h!==void 0?h.length:0,d=n.get(a);if(d===void 0||d.count!==u){let L=function(){x.dispose(),n.delete(a),a.removeEventListener("dispose",L)};d!==void 0&&d.texture.dispose();let f=a.morphAttributes.position!==void 0,m=a.morphAttributes.normal!==void 0,y=a.morphAttributes.color!==void 0,p=a.morphAttributes.position||[],g=a.morphAttributes.normal||[],_=a.morphAttributes.color||[],w=0;f===!0&&(w=1),m===!0&&(w=2),y===!0&&(w=3);let v=a.attributes.position.count*w,A=1;v>t.maxTextureSize&&(A=Math.ceil(v/t.maxTextureSize),v=t.maxTextureSize);let S=new Float32Array(v*A*4*u),x=new bl(S,v,A,u);x.type=ki,x.needsUpdate=!0;let M=w*4;for(let P=0;P<u;P++){let R=p[P],O=g[P],k=_[P],N=v*A*4*P;for(let W=0;W<R.count;W++){let z=W*M;f===!0&&(i.fromBufferAttribute(R,W),S[N+z+0]=i.x,S[N+z+1]=i.y,S[N+z+2]=i.z,S[N+z+3]=0),m===!0&&(i.fromBufferAttribute(O,W),S[N+z+4]=i.x,S[N+z+5]=i.y,S[N+z+6]=i.z,S[N+z+7]=0),y===!0&&(i.fromBufferAttribute(k,W),S[N+z+8]=i.x,S[N+z+9]=i.y,S[N+z+10]=i.z,S[N+z+11]=k.itemSize===4?i.w:1)}}d={count:u,texture:x,size:new Xt(v,A)},n.set(a,d),a.addEventListener("dispose",L)}if(o.isInstancedMesh===!0&&o.morphTexture!==null)l.getUniforms().setValue(s,"morphTexture",o.morphTexture,e);else{let f=0;for(let y=0;y<c.length;y++)f+=c[y];let m=a.morphTargetsRelative?1:1-f;l.getUniforms().setValue(s,"morphTargetBaseInfluence",m),l.getUniforms().setValue(s,"morphTargetInfluences",c)}l.getUniforms().setValue(s,"morphTargetsTexture",d.texture,e),l.getUniforms().setValue(s,"morphTargetsTextureSize",d.size)}return{update:r}}function yC(s,t,e,n,i){let r=new WeakMap;function o(c){let h=i.render.frame,u=c.geometry,d=t.get(c,u);if(r.get(d)!==h&&(t.update(d),r.set(d,h)),c.isInstancedMesh&&(c.hasEventListener("dispose",l)===!1&&c.addEventListener("dispose",l),r.get(c)!==h&&(e.update(c.instanceMatrix,s.ARRAY_BUFFER),c.instanceColor!==null&&e.update(c.instanceColor,s.ARRAY_BUFFER),r.set(c,h))),c.isSkinnedMesh){let f=c.skeleton;r.get(f)!==h&&(f.update(),r.set(f,h))}return d}function a(){r=new WeakMap}function l(c){let h=c.target;h.removeEventListener("dispose",l),n.releaseStatesOfObject(h),e.remove(h.instanceMatrix),h.instanceColor!==null&&e.remove(h.instanceColor)}return{update:o,dispose:a}}var _C={[em]:"LINEAR_TONE_MAPPING",[nm]:"REINHARD_TONE_MAPPING",[im]:"CINEON_TONE_MAPPING",[sm]:"ACES_FILMIC_TONE_MAPPING",[om]:"AGX_TONE_MAPPING",[am]:"NEUTRAL_TONE_MAPPING",[rm]:"CUSTOM_TONE_MAPPING"};function xC(s,t,e,n,i,r){let o=new Fi(t,e,{type:s,depthBuffer:i,stencilBuffer:r,samples:n?4:0,storeMultisampledDepthBuffer:!1,storeMultisampledStencilBuffer:!1,resolveDepthBuffer:!1,resolveStencilBuffer:!1}),a=null,l=null,c=null,h=new Ae;h.setAttribute("position",new $t([-1,3,0,-1,-1,0,3,-1,0],3)),h.setAttribute("uv",new $t([0,2,0,0,2,0],2));let u=new ou({uniforms:{tDiffuse:{value:null}},vertexShader:`
			precision highp float;

			uniform mat4 modelViewMatrix;
			uniform mat4 projectionMatrix;

			attribute vec3 position;
			attribute vec2 uv;

			varying vec2 vUv;

			void main() {
				vUv = uv;
				gl_Position = projectionMatrix * modelViewMatrix * vec4( position, 1.0 );
			}`,fragmentShader:`
			precision highp float;

			uniform sampler2D tDiffuse;

			varying vec2 vUv;

			#include <tonemapping_pars_fragment>
			#include <colorspace_pars_fragment>

			void main() {
				gl_FragColor = texture2D( tDiffuse, vUv );

				#ifdef LINEAR_TONE_MAPPING
					gl_FragColor.rgb = LinearToneMapping( gl_FragColor.rgb );
				#elif defined( REINHARD_TONE_MAPPING )
					gl_FragColor.rgb = ReinhardToneMapping( gl_FragColor.rgb );
				#elif defined( CINEON_TONE_MAPPING )
					gl_FragColor.rgb = CineonToneMapping( gl_FragColor.rgb );
				#elif defined( ACES_FILMIC_TONE_MAPPING )
					gl_FragColor.rgb = ACESFilmicToneMapping( gl_FragColor.rgb );
				#elif defined( AGX_TONE_MAPPING )
					gl_FragColor.rgb = AgXToneMapping( gl_FragColor.rgb );
				#elif defined( NEUTRAL_TONE_MAPPING )
					gl_FragColor.rgb = NeutralToneMapping( gl_FragColor.rgb );
				#elif defined( CUSTOM_TONE_MAPPING )
					gl_FragColor.rgb = CustomToneMapping( gl_FragColor.rgb );
				#endif

				#ifdef SRGB_TRANSFER
					gl_FragColor = sRGBTransferOETF( gl_FragColor );
				#endif
			}`,depthTest:!1,depthWrite:!1}),d=new de(h,u),f=new uo(-1,1,1,-1,0,1),m=null,y=null,p=!1,g,_=null,w=[],v=!1;this.setSize=function(A,S){o.setSize(A,S),a!==null&&a.setSize(A,S),l!==null&&l.setSize(A,S);for(let x=0;x<w.length;x++){let M=w[x];M.setSize&&M.setSize(A,S)}},this.setEffects=function(A){w=A,v=w.length>0&&w[0].isRenderPass===!0;let S=o.width,x=o.height;w.length>0&&a===null&&(a=new Fi(S,x,{type:ds,depthBuffer:!1,stencilBuffer:!1}),l=new Fi(S,x,{type:ds,depthBuffer:!1,stencilBuffer:!1}));let M=i===!0&&w.some(L=>L.needsDepthTexture===!0);M!==(o.depthTexture!==null)&&(M===!0&&c===null&&(c=new Qs(S,x),r===!0&&(c.format=sr,c.type=xo)),o.dispose(),o.depthTexture=M?c:null,o.resolveDepthBuffer=M,o.storeMultisampledDepthBuffer=M);for(let L=0;L<w.length;L++){let P=w[L];P.setSize&&P.setSize(S,x),M&&P.needsDepthTexture===!0&&P.setDepthTexture&&P.setDepthTexture(c)}},this.begin=function(A,S){if(p||A.toneMapping===Cs&&w.length===0)return!1;if(_=S,S!==null){let x=S.width,M=S.height;(o.width!==x||o.height!==M)&&this.setSize(x,M)}return v===!1&&A.setRenderTarget(o),g=A.toneMapping,A.toneMapping=Cs,!0},this.hasRenderPass=function(){return v},this.end=function(A,S){A.toneMapping=g,p=!0;let x=o,M=a;for(let L=0;L<w.length;L++){let P=w[L];P.enabled!==!1&&(P.render(A,M,x,S),P.needsSwap!==!1&&(x=M,M=M===a?l:a))}if(m!==A.outputColorSpace||y!==A.toneMapping){m=A.outputColorSpace,y=A.toneMapping,u.defines={},ue.getTransfer(m)===Ne&&(u.defines.SRGB_TRANSFER="");let L=_C[y];L&&(u.defines[L]=""),u.needsUpdate=!0}u.uniforms.tDiffuse.value=x.texture,A.setRenderTarget(_),A.render(d,f),_=null,p=!1},this.isCompositing=function(){return p},this.dispose=function(){o.dispose(),a!==null&&a.dispose(),l!==null&&l.dispose(),h.dispose(),u.dispose()}}var iv=new mi,sv=new Qs(1,1),rv=new Pl(1),ov=new bl,av=new eu,lv=new Rl,Fx=[],Ux=[],Bx=new Float32Array(16),kx=new Float32Array(9),zx=new Float32Array(4);function La(s,t,e){let n=s[0];if(n<=0||n>0)return s;let i=t*e,r=Fx[i];if(r===void 0&&(r=new Float32Array(i),Fx[i]=r),t!==0){n.toArray(r,0);for(let o=1,a=0;o!==t;++o)a+=e,s[o].toArray(r,a)}return r}function Cn(s,t){if(s.length!==t.length)return!1;for(let e=0,n=s.length;e<n;e++)if(s[e]!==t[e])return!1;return!0}function Rn(s,t){for(let e=0,n=t.length;e<n;e++)s[e]=t[e]}function ld(s,t){let e=Ux[t];e===void 0&&(e=new Int32Array(t),Ux[t]=e);for(let n=0;n!==t;++n)e[n]=s.allocateTextureUnit();return e}function vC(s,t){let e=this.cache;e[0]!==t&&(s.uniform1f(this.addr,t),e[0]=t)}function bC(s,t){let e=this.cache;if(t.x!==void 0)(e[0]!==t.x||e[1]!==t.y)&&(s.uniform2f(this.addr,t.x,t.y),e[0]=t.x,e[1]=t.y);else{if(Cn(e,t))return;s.uniform2fv(this.addr,t),Rn(e,t)}}function SC(s,t){let e=this.cache;if(t.x!==void 0)(e[0]!==t.x||e[1]!==t.y||e[2]!==t.z)&&(s.uniform3f(this.addr,t.x,t.y,t.z),e[0]=t.x,e[1]=t.y,e[2]=t.z);else if(t.r!==void 0)(e[0]!==t.r||e[1]!==t.g||e[2]!==t.b)&&(s.uniform3f(this.addr,t.r,t.g,t.b),e[0]=t.r,e[1]=t.g,e[2]=t.b);else{if(Cn(e,t))return;s.uniform3fv(this.addr,t),Rn(e,t)}}function MC(s,t){let e=this.cache;if(t.x!==void 0)(e[0]!==t.x||e[1]!==t.y||e[2]!==t.z||e[3]!==t.w)&&(s.uniform4f(this.addr,t.x,t.y,t.z,t.w),e[0]=t.x,e[1]=t.y,e[2]=t.z,e[3]=t.w);else{if(Cn(e,t))return;s.uniform4fv(this.addr,t),Rn(e,t)}}function wC(s,t){let e=this.cache,n=t.elements;if(n===void 0){if(Cn(e,t))return;s.uniformMatrix2fv(this.addr,!1,t),Rn(e,t)}else{if(Cn(e,n))return;zx.set(n),s.uniformMatrix2fv(this.addr,!1,zx),Rn(e,n)}}function TC(s,t){let e=this.cache,n=t.elements;if(n===void 0){if(Cn(e,t))return;s.uniformMatrix3fv(this.addr,!1,t),Rn(e,t)}else{if(Cn(e,n))return;kx.set(n),s.uniformMatrix3fv(this.addr,!1,kx),Rn(e,n)}}function AC(s,t){let e=this.cache,n=t.elements;if(n===void 0){if(Cn(e,t))return;s.uniformMatrix4fv(this.addr,!1,t),Rn(e,t)}else{if(Cn(e,n))return;Bx.set(n),s.uniformMatrix4fv(this.addr,!1,Bx),Rn(e,n)}}function EC(s,t){let e=this.cache;e[0]!==t&&(s.uniform1i(this.addr,t),e[0]=t)}function CC(s,t){let e=this.cache;if(t.x!==void 0)(e[0]!==t.x||e[1]!==t.y)&&(s.uniform2i(this.addr,t.x,t.y),e[0]=t.x,e[1]=t.y);else{if(Cn(e,t))return;s.uniform2iv(this.addr,t),Rn(e,t)}}function RC(s,t){let e=this.cache;if(t.x!==void 0)(e[0]!==t.x||e[1]!==t.y||e[2]!==t.z)&&(s.uniform3i(this.addr,t.x,t.y,t.z),e[0]=t.x,e[1]=t.y,e[2]=t.z);else{if(Cn(e,t))return;s.uniform3iv(this.addr,t),Rn(e,t)}}function PC(s,t){let e=this.cache;if(t.x!==void 0)(e[0]!==t.x||e[1]!==t.y||e[2]!==t.z||e[3]!==t.w)&&(s.uniform4i(this.addr,t.x,t.y,t.z,t.w),e[0]=t.x,e[1]=t.y,e[2]=t.z,e[3]=t.w);else{if(Cn(e,t))return;s.uniform4iv(this.addr,t),Rn(e,t)}}function LC(s,t){let e=this.cache;e[0]!==t&&(s.uniform1ui(this.addr,t),e[0]=t)}function IC(s,t){let e=this.cache;if(t.x!==void 0)(e[0]!==t.x||e[1]!==t.y)&&(s.uniform2ui(this.addr,t.x,t.y),e[0]=t.x,e[1]=t.y);else{if(Cn(e,t))return;s.uniform2uiv(this.addr,t),Rn(e,t)}}function NC(s,t){let e=this.cache;if(t.x!==void 0)(e[0]!==t.x||e[1]!==t.y||e[2]!==t.z)&&(s.uniform3ui(this.addr,t.x,t.y,t.z),e[0]=t.x,e[1]=t.y,e[2]=t.z);else{if(Cn(e,t))return;s.uniform3uiv(this.addr,t),Rn(e,t)}}function DC(s,t){let e=this.cache;if(t.x!==void 0)(e[0]!==t.x||e[1]!==t.y||e[2]!==t.z||e[3]!==t.w)&&(s.uniform4ui(this.addr,t.x,t.y,t.z,t.w),e[0]=t.x,e[1]=t.y,e[2]=t.z,e[3]=t.w);else{if(Cn(e,t))return;s.uniform4uiv(this.addr,t),Rn(e,t)}}function cd(s){return s.version===0&&(s.compareFunction=ym,s.needsUpdate=!0),s}function OC(s,t,e){let n=this.cache,i=e.allocateTextureUnit();n[0]!==i&&(s.uniform1i(this.addr,i),n[0]=i);let r;this.type===s.SAMPLER_2D_SHADOW?r=cd(sv):r=iv,e.setTexture2D(t||r,i)}function FC(s,t,e){let n=this.cache,i=e.allocateTextureUnit();n[0]!==i&&(s.uniform1i(this.addr,i),n[0]=i),e.setTexture3D(t||av,i)}function UC(s,t,e){let n=this.cache,i=e.allocateTextureUnit();n[0]!==i&&(s.uniform1i(this.addr,i),n[0]=i);let r;this.type===s.SAMPLER_CUBE_SHADOW?r=cd(rv):r=lv,e.setTextureCube(t||r,i)}function BC(s,t,e){let n=this.cache,i=e.allocateTextureUnit();n[0]!==i&&(s.uniform1i(this.addr,i),n[0]=i),e.setTexture2DArray(t||ov,i)}function kC(s){switch(s){case 5126:return vC;case 35664:return bC;case 35665:return SC;case 35666:return MC;case 35674:return wC;case 35675:return TC;case 35676:return AC;case 5124:case 35670:return EC;case 35667:case 35671:return CC;case 35668:case 35672:return RC;case 35669:case 35673:return PC;case 5125:return LC;case 36294:return IC;case 36295:return NC;case 36296:return DC;case 35678:case 36198:case 36298:case 36306:case 35682:return OC;case 35679:case 36299:case 36307:return FC;case 35680:case 36300:case 36308:case 36293:return UC;case 36289:case 36303:case 36311:case 36292:return BC}}function zC(s,t){s.uniform1fv(this.addr,t)}function VC(s,t){let e=La(t,this.size,2);s.uniform2fv(this.addr,e)}function GC(s,t){let e=La(t,this.size,3);s.uniform3fv(this.addr,e)}function HC(s,t){let e=La(t,this.size,4);s.uniform4fv(this.addr,e)}function WC(s,t){let e=La(t,this.size,4);s.uniformMatrix2fv(this.addr,!1,e)}function XC(s,t){let e=La(t,this.size,9);s.uniformMatrix3fv(this.addr,!1,e)}function qC(s,t){let e=La(t,this.size,16);s.uniformMatrix4fv(this.addr,!1,e)}function jC(s,t){s.uniform1iv(this.addr,t)}function YC(s,t){s.uniform2iv(this.addr,t)}function $C(s,t){s.uniform3iv(this.addr,t)}function JC(s,t){s.uniform4iv(this.addr,t)}function KC(s,t){s.uniform1uiv(this.addr,t)}function ZC(s,t){s.uniform2uiv(this.addr,t)}function QC(s,t){s.uniform3uiv(this.addr,t)}function tR(s,t){s.uniform4uiv(this.addr,t)}function eR(s,t,e){let n=this.cache,i=t.length,r=ld(e,i);Cn(n,r)||(s.uniform1iv(this.addr,r),Rn(n,r));let o;this.type===s.SAMPLER_2D_SHADOW?o=cd(sv):o=iv;for(let a=0;a!==i;++a)e.setTexture2D(t[a]||o,r[a])}function nR(s,t,e){let n=this.cache,i=t.length,r=ld(e,i);Cn(n,r)||(s.uniform1iv(this.addr,r),Rn(n,r));for(let o=0;o!==i;++o)e.setTexture3D(t[o]||av,r[o])}function iR(s,t,e){let n=this.cache,i=t.length,r=ld(e,i);Cn(n,r)||(s.uniform1iv(this.addr,r),Rn(n,r));let o;this.type===s.SAMPLER_CUBE_SHADOW?o=cd(rv):o=lv;for(let a=0;a!==i;++a)e.setTextureCube(t[a]||o,r[a])}function sR(s,t,e){let n=this.cache,i=t.length,r=ld(e,i);Cn(n,r)||(s.uniform1iv(this.addr,r),Rn(n,r));for(let o=0;o!==i;++o)e.setTexture2DArray(t[o]||ov,r[o])}function rR(s){switch(s){case 5126:return zC;case 35664:return VC;case 35665:return GC;case 35666:return HC;case 35674:return WC;case 35675:return XC;case 35676:return qC;case 5124:case 35670:return jC;case 35667:case 35671:return YC;case 35668:case 35672:return $C;case 35669:case 35673:return JC;case 5125:return KC;case 36294:return ZC;case 36295:return QC;case 36296:return tR;case 35678:case 36198:case 36298:case 36306:case 35682:return eR;case 35679:case 36299:case 36307:return nR;case 35680:case 36300:case 36308:case 36293:return iR;case 36289:case 36303:case 36311:case 36292:return sR}}var Pm=class{constructor(t,e,n){this.id=t,this.addr=n,this.cache=[],this.type=e.type,this.setValue=kC(e.type)}},Lm=class{constructor(t,e,n){this.id=t,this.addr=n,this.cache=[],this.type=e.type,this.size=e.size,this.setValue=rR(e.type)}},Im=class{constructor(t){this.id=t,this.seq=[],this.map={}}setValue(t,e,n){let i=this.seq;for(let r=0,o=i.length;r!==o;++r){let a=i[r];a.setValue(t,e[a.id],n)}}},Cm=/(\w+)(\])?(\[|\.)?/g;function Vx(s,t){s.seq.push(t),s.map[t.id]=t}function oR(s,t,e){let n=s.name,i=n.length;for(Cm.lastIndex=0;;){let r=Cm.exec(n),o=Cm.lastIndex,a=r[1],l=r[2]==="]",c=r[3];if(l&&(a=a|0),c===void 0||c==="["&&o+2===i){Vx(e,c===void 0?new Pm(a,s,t):new Lm(a,s,t));break}else{let u=e.map[a];u===void 0&&(u=new Im(a),Vx(e,u)),e=u}}}var Pa=class{constructor(t,e){this.seq=[],this.map={};let n=t.getProgramParameter(e,t.ACTIVE_UNIFORMS);for(let o=0;o<n;++o){let a=t.getActiveUniform(e,o),l=t.getUniformLocation(e,a.name);oR(a,l,this)}let i=[],r=[];for(let o of this.seq)o.type===t.SAMPLER_2D_SHADOW||o.type===t.SAMPLER_CUBE_SHADOW||o.type===t.SAMPLER_2D_ARRAY_SHADOW?i.push(o):r.push(o);i.length>0&&(this.seq=i.concat(r))}setValue(t,e,n,i){let r=this.map[e];r!==void 0&&r.setValue(t,n,i)}setOptional(t,e,n){let i=e[n];i!==void 0&&this.setValue(t,n,i)}static upload(t,e,n,i){for(let r=0,o=e.length;r!==o;++r){let a=e[r],l=n[a.id];l.needsUpdate!==!1&&a.setValue(t,l.value,i)}}static seqWithValue(t,e){let n=[];for(let i=0,r=t.length;i!==r;++i){let o=t[i];o.id in e&&n.push(o)}return n}};function Gx(s,t,e){let n=s.createShader(t);return s.shaderSource(n,e),s.compileShader(n),n}var aR=37297,lR=0;function cR(s,t){let e=s.split(`
`),n=[],i=Math.max(t-6,0),r=Math.min(t+6,e.length);for(let o=i;o<r;o++){let a=o+1;n.push(`${a===t?">":" "} ${a}: ${e[o]}`)}return n.join(`
`)}var Hx=new se;function hR(s){ue._getMatrix(Hx,ue.workingColorSpace,s);let t=`mat3( ${Hx.elements.map(e=>e.toFixed(4))} )`;switch(ue.getTransfer(s)){case xl:return[t,"LinearTransferOETF"];case Ne:return[t,"sRGBTransferOETF"];default:return Yt("WebGLProgram: Unsupported color space: ",s),[t,"LinearTransferOETF"]}}function Wx(s,t,e){let n=s.getShaderParameter(t,s.COMPILE_STATUS),r=(s.getShaderInfoLog(t)||"").trim();if(n&&r==="")return"";let o=/ERROR: 0:(\d+)/.exec(r);if(o){let a=parseInt(o[1]);return e.toUpperCase()+`

`+r+`

`+cR(s.getShaderSource(t),a)}else return r}function uR(s,t){let e=hR(t);return[`vec4 ${s}( vec4 value ) {`,`	return ${e[1]}( vec4( ${e[0]} * value.rgb, value.a ) );`,"}"].join(`
`)}var dR={[em]:"Linear",[nm]:"Reinhard",[im]:"Cineon",[sm]:"ACESFilmic",[om]:"AgX",[am]:"Neutral",[rm]:"Custom"};function fR(s,t){let e=dR[t];return e===void 0?(Yt("WebGLProgram: Unsupported toneMapping:",t),"vec3 "+s+"( vec3 color ) { return LinearToneMapping( color ); }"):"vec3 "+s+"( vec3 color ) { return "+e+"ToneMapping( color ); }"}var rd=new F;function pR(){ue.getLuminanceCoefficients(rd);let s=rd.x.toFixed(4),t=rd.y.toFixed(4),e=rd.z.toFixed(4);return["float luminance( const in vec3 rgb ) {",`	const vec3 weights = vec3( ${s}, ${t}, ${e} );`,"	return dot( weights, rgb );","}"].join(`
`)}function mR(s){return[s.extensionClipCullDistance?"#extension GL_ANGLE_clip_cull_distance : require":"",s.extensionMultiDraw?"#extension GL_ANGLE_multi_draw : require":""].filter(oc).join(`
`)}function gR(s){let t=[];for(let e in s){let n=s[e];n!==!1&&t.push("#define "+e+" "+n)}return t.join(`
`)}function yR(s,t){let e={},n=s.getProgramParameter(t,s.ACTIVE_ATTRIBUTES);for(let i=0;i<n;i++){let r=s.getActiveAttrib(t,i),o=r.name,a=1;r.type===s.FLOAT_MAT2&&(a=2),r.type===s.FLOAT_MAT3&&(a=3),r.type===s.FLOAT_MAT4&&(a=4),e[o]={type:r.type,location:s.getAttribLocation(t,o),locationSize:a}}return e}function oc(s){return s!==""}function Xx(s,t){let e=t.numSpotLightShadows+t.numSpotLightMaps-t.numSpotLightShadowsWithMaps;return s.replace(/NUM_SUN_LIGHTS/g,t.numSunLights).replace(/NUM_DIR_LIGHTS/g,t.numDirLights).replace(/NUM_SPOT_LIGHTS/g,t.numSpotLights).replace(/NUM_SPOT_LIGHT_MAPS/g,t.numSpotLightMaps).replace(/NUM_SPOT_LIGHT_COORDS/g,e).replace(/NUM_RECT_AREA_LIGHTS/g,t.numRectAreaLights).replace(/NUM_POINT_LIGHTS/g,t.numPointLights).replace(/NUM_HEMI_LIGHTS/g,t.numHemiLights).replace(/NUM_SUN_LIGHT_SHADOWS/g,t.numSunLightShadows).replace(/NUM_DIR_LIGHT_SHADOWS/g,t.numDirLightShadows).replace(/NUM_SPOT_LIGHT_SHADOWS_WITH_MAPS/g,t.numSpotLightShadowsWithMaps).replace(/NUM_SPOT_LIGHT_SHADOWS/g,t.numSpotLightShadows).replace(/NUM_POINT_LIGHT_SHADOWS/g,t.numPointLightShadows).replace(/NUM_LIGHT_PROBE_GRIDS/g,t.numLightProbeGrids)}function qx(s,t){return s.replace(/NUM_CLIPPING_PLANES/g,t.numClippingPlanes).replace(/UNION_CLIPPING_PLANES/g,t.numClippingPlanes-t.numClipIntersection)}var _R=/^[ \t]*#include +<([\w\d./]+)>/gm;function Nm(s){return s.replace(_R,xR)}function xR(s,t){let e=me[t];if(e===void 0)throw new Error("THREE.WebGLProgram: Can not resolve #include <"+t+">");return Nm(e)}var vR=/#pragma unroll_loop_start\s+for\s*\(\s*int\s+i\s*=\s*(\d+)\s*;\s*i\s*<\s*(\d+)\s*;\s*i\s*\+\+\s*\)\s*{([\s\S]+?)}\s+#pragma unroll_loop_end/g;function jx(s){return s.replace(vR,bR)}function bR(s,t,e,n){let i="";for(let r=parseInt(t);r<parseInt(e);r++)i+=n.replace(/\[\s*i\s*\]/g,"[ "+r+" ]").replace(/UNROLLED_LOOP_INDEX/g,r);return i}function Yx(s){let t=`precision ${s.precision} float;
	precision ${s.precision} int;
	precision ${s.precision} sampler2D;
	precision ${s.precision} samplerCube;
	precision ${s.precision} sampler3D;
	precision ${s.precision} sampler2DArray;
	precision ${s.precision} sampler2DShadow;
	precision ${s.precision} samplerCubeShadow;
	precision ${s.precision} sampler2DArrayShadow;
	precision ${s.precision} isampler2D;
	precision ${s.precision} isampler3D;
	precision ${s.precision} isamplerCube;
	precision ${s.precision} isampler2DArray;
	precision ${s.precision} usampler2D;
	precision ${s.precision} usampler3D;
	precision ${s.precision} usamplerCube;
	precision ${s.precision} usampler2DArray;
	`;return s.precision==="highp"?t+=`
#define HIGH_PRECISION`:s.precision==="mediump"?t+=`
#define MEDIUM_PRECISION`:s.precision==="lowp"&&(t+=`
#define LOW_PRECISION`),t}var SR={[mo]:"SHADOWMAP_TYPE_PCF",[Aa]:"SHADOWMAP_TYPE_VSM"};function MR(s){return SR[s.shadowMapType]||"SHADOWMAP_TYPE_BASIC"}var wR={[Ca]:"ENVMAP_MODE_REFRACTION"};function TR(s){return s.envMap===!1?"ENVMAP_MODE_REFLECTION":wR[s.envMapMode]||"ENVMAP_MODE_REFLECTION"}var AR={[$l]:"ENVMAP_BLENDING_MULTIPLY",[cx]:"ENVMAP_BLENDING_MIX",[hx]:"ENVMAP_BLENDING_ADD"};function ER(s){return s.envMap===!1?"ENVMAP_BLENDING_NONE":AR[s.combine]||"ENVMAP_BLENDING_NONE"}function CR(s,t,e,n){let i=s.getContext(),r=e.defines,o=e.vertexShader,a=e.fragmentShader,l=MR(e),c=e.envMapPMREM===!0?"ENVMAP_TYPE_PMREM":"ENVMAP_TYPE_CUBE",h=TR(e),u=ER(e),d=mR(e),f=gR(r),m=i.createProgram(),y,p,g=e.glslVersion?"#version "+e.glslVersion+`
`:"";e.isRawShaderMaterial?(y=["#define SHADER_TYPE "+e.shaderType,"#define SHADER_NAME "+e.shaderName,f].filter(oc).join(`
`),y.length>0&&(y+=`
`),p=["#define SHADER_TYPE "+e.shaderType,"#define SHADER_NAME "+e.shaderName,f].filter(oc).join(`
`),p.length>0&&(p+=`
`)):(y=[Yx(e),"#define SHADER_TYPE "+e.shaderType,"#define SHADER_NAME "+e.shaderName,f,e.extensionClipCullDistance?"#define USE_CLIP_DISTANCE":"",e.batching?"#define USE_BATCHING":"",e.batchingColor?"#define USE_BATCHING_COLOR":"",e.instancing?"#define USE_INSTANCING":"",e.instancingColor?"#define USE_INSTANCING_COLOR":"",e.instancingMorph?"#define USE_INSTANCING_MORPH":"",e.useFog&&e.fog?"#define USE_FOG":"",e.useFog&&e.fogExp2?"#define FOG_EXP2":"",e.map?"#define USE_MAP":"",e.envMap?"#define USE_ENVMAP":"",e.envMap?"#define "+h:"",e.lightMap?"#define USE_LIGHTMAP":"",e.aoMap?"#define USE_AOMAP":"",e.bumpMap?"#define USE_BUMPMAP":"",e.normalMap?"#define USE_NORMALMAP":"",e.normalMapObjectSpace?"#define USE_NORMALMAP_OBJECTSPACE":"",e.normalMapTangentSpace?"#define USE_NORMALMAP_TANGENTSPACE":"",e.displacementMap?"#define USE_DISPLACEMENTMAP":"",e.emissiveMap?"#define USE_EMISSIVEMAP":"",e.anisotropy?"#define USE_ANISOTROPY":"",e.anisotropyMap?"#define USE_ANISOTROPYMAP":"",e.clearcoatMap?"#define USE_CLEARCOATMAP":"",e.clearcoatRoughnessMap?"#define USE_CLEARCOAT_ROUGHNESSMAP":"",e.clearcoatNormalMap?"#define USE_CLEARCOAT_NORMALMAP":"",e.diffuseRoughnessMap?"#define USE_DIFFUSE_ROUGHNESSMAP":"",e.iridescenceMap?"#define USE_IRIDESCENCEMAP":"",e.iridescenceThicknessMap?"#define USE_IRIDESCENCE_THICKNESSMAP":"",e.specularMap?"#define USE_SPECULARMAP":"",e.specularColorMap?"#define USE_SPECULAR_COLORMAP":"",e.specularIntensityMap?"#define USE_SPECULAR_INTENSITYMAP":"",e.roughnessMap?"#define USE_ROUGHNESSMAP":"",e.metalnessMap?"#define USE_METALNESSMAP":"",e.alphaMap?"#define USE_ALPHAMAP":"",e.alphaHash?"#define USE_ALPHAHASH":"",e.transmission?"#define USE_TRANSMISSION":"",e.transmissionMap?"#define USE_TRANSMISSIONMAP":"",e.thicknessMap?"#define USE_THICKNESSMAP":"",e.sheenColorMap?"#define USE_SHEEN_COLORMAP":"",e.sheenRoughnessMap?"#define USE_SHEEN_ROUGHNESSMAP":"",e.mapUv?"#define MAP_UV "+e.mapUv:"",e.alphaMapUv?"#define ALPHAMAP_UV "+e.alphaMapUv:"",e.lightMapUv?"#define LIGHTMAP_UV "+e.lightMapUv:"",e.aoMapUv?"#define AOMAP_UV "+e.aoMapUv:"",e.emissiveMapUv?"#define EMISSIVEMAP_UV "+e.emissiveMapUv:"",e.bumpMapUv?"#define BUMPMAP_UV "+e.bumpMapUv:"",e.normalMapUv?"#define NORMALMAP_UV "+e.normalMapUv:"",e.displacementMapUv?"#define DISPLACEMENTMAP_UV "+e.displacementMapUv:"",e.metalnessMapUv?"#define METALNESSMAP_UV "+e.metalnessMapUv:"",e.roughnessMapUv?"#define ROUGHNESSMAP_UV "+e.roughnessMapUv:"",e.anisotropyMapUv?"#define ANISOTROPYMAP_UV "+e.anisotropyMapUv:"",e.clearcoatMapUv?"#define CLEARCOATMAP_UV "+e.clearcoatMapUv:"",e.clearcoatNormalMapUv?"#define CLEARCOAT_NORMALMAP_UV "+e.clearcoatNormalMapUv:"",e.clearcoatRoughnessMapUv?"#define CLEARCOAT_ROUGHNESSMAP_UV "+e.clearcoatRoughnessMapUv:"",e.diffuseRoughnessMapUv?"#define DIFFUSE_ROUGHNESSMAP_UV "+e.diffuseRoughnessMapUv:"",e.iridescenceMapUv?"#define IRIDESCENCEMAP_UV "+e.iridescenceMapUv:"",e.iridescenceThicknessMapUv?"#define IRIDESCENCE_THICKNESSMAP_UV "+e.iridescenceThicknessMapUv:"",e.sheenColorMapUv?"#define SHEEN_COLORMAP_UV "+e.sheenColorMapUv:"",e.sheenRoughnessMapUv?"#define SHEEN_ROUGHNESSMAP_UV "+e.sheenRoughnessMapUv:"",e.specularMapUv?"#define SPECULARMAP_UV "+e.specularMapUv:"",e.specularColorMapUv?"#define SPECULAR_COLORMAP_UV "+e.specularColorMapUv:"",e.specularIntensityMapUv?"#define SPECULAR_INTENSITYMAP_UV "+e.specularIntensityMapUv:"",e.transmissionMapUv?"#define TRANSMISSIONMAP_UV "+e.transmissionMapUv:"",e.thicknessMapUv?"#define THICKNESSMAP_UV "+e.thicknessMapUv:"",e.vertexTangents&&e.flatShading===!1?"#define USE_TANGENT":"",e.vertexNormals?"#define HAS_NORMAL":"",e.vertexColors?"#define USE_COLOR":"",e.vertexAlphas?"#define USE_COLOR_ALPHA":"",e.vertexUv1s?"#define USE_UV1":"",e.vertexUv2s?"#define USE_UV2":"",e.vertexUv3s?"#define USE_UV3":"",e.pointsUvs?"#define USE_POINTS_UV":"",e.flatShading?"#define FLAT_SHADED":"",e.skinning?"#define USE_SKINNING":"",e.morphTargets?"#define USE_MORPHTARGETS":"",e.morphNormals&&e.flatShading===!1?"#define USE_MORPHNORMALS":"",e.morphColors?"#define USE_MORPHCOLORS":"",e.morphTargetsCount>0?"#define MORPHTARGETS_TEXTURE_STRIDE "+e.morphTextureStride:"",e.morphTargetsCount>0?"#define MORPHTARGETS_COUNT "+e.morphTargetsCount:"",e.doubleSided?"#define DOUBLE_SIDED":"",e.flipSided?"#define FLIP_SIDED":"",e.shadowMapEnabled?"#define USE_SHADOWMAP":"",e.shadowMapEnabled?"#define "+l:"",e.sizeAttenuation?"#define USE_SIZEATTENUATION":"",e.numLightProbes>0?"#define USE_LIGHT_PROBES":"",e.logarithmicDepthBuffer?"#define USE_LOGARITHMIC_DEPTH_BUFFER":"",e.reversedDepthBuffer?"#define USE_REVERSED_DEPTH_BUFFER":"","uniform mat4 modelMatrix;","uniform mat4 modelViewMatrix;","uniform mat4 projectionMatrix;","uniform mat4 viewMatrix;","uniform mat3 normalMatrix;","uniform vec3 cameraPosition;","uniform bool isOrthographic;","#ifdef USE_INSTANCING","	attribute mat4 instanceMatrix;","#endif","#ifdef USE_INSTANCING_COLOR","	attribute vec3 instanceColor;","#endif","#ifdef USE_INSTANCING_MORPH","	uniform sampler2D morphTexture;","#endif","attribute vec3 position;","attribute vec3 normal;","attribute vec2 uv;","#ifdef USE_UV1","	attribute vec2 uv1;","#endif","#ifdef USE_UV2","	attribute vec2 uv2;","#endif","#ifdef USE_UV3","	attribute vec2 uv3;","#endif","#ifdef USE_TANGENT","	attribute vec4 tangent;","#endif","#if defined( USE_COLOR_ALPHA )","	attribute vec4 color;","#elif defined( USE_COLOR )","	attribute vec3 color;","#endif","#ifdef USE_SKINNING","	attribute vec4 skinIndex;","	attribute vec4 skinWeight;","#endif",`
`].filter(oc).join(`
`),p=[Yx(e),"#define SHADER_TYPE "+e.shaderType,"#define SHADER_NAME "+e.shaderName,f,e.useFog&&e.fog?"#define USE_FOG":"",e.useFog&&e.fogExp2?"#define FOG_EXP2":"",e.alphaToCoverage?"#define ALPHA_TO_COVERAGE":"",e.map?"#define USE_MAP":"",e.matcap?"#define USE_MATCAP":"",e.envMap?"#define USE_ENVMAP":"",e.envMap?"#define "+c:"",e.envMap?"#define "+h:"",e.envMap?"#define "+u:"",e.envMapPMREM?"#define ENVMAP_MAX_LOD "+e.envMapMaxLod+".0":"",e.envMapPMREM?"#define ENVMAP_SIZE "+e.envMapSize+".0":"",e.lightMap?"#define USE_LIGHTMAP":"",e.aoMap?"#define USE_AOMAP":"",e.bumpMap?"#define USE_BUMPMAP":"",e.normalMap?"#define USE_NORMALMAP":"",e.normalMapObjectSpace?"#define USE_NORMALMAP_OBJECTSPACE":"",e.normalMapTangentSpace?"#define USE_NORMALMAP_TANGENTSPACE":"",e.packedNormalMap?"#define USE_PACKED_NORMALMAP":"",e.emissiveMap?"#define USE_EMISSIVEMAP":"",e.anisotropy?"#define USE_ANISOTROPY":"",e.anisotropyMap?"#define USE_ANISOTROPYMAP":"",e.clearcoat?"#define USE_CLEARCOAT":"",e.clearcoatMap?"#define USE_CLEARCOATMAP":"",e.clearcoatRoughnessMap?"#define USE_CLEARCOAT_ROUGHNESSMAP":"",e.clearcoatNormalMap?"#define USE_CLEARCOAT_NORMALMAP":"",e.diffuseRoughness?"#define USE_DIFFUSE_ROUGHNESS":"",e.diffuseRoughnessMap?"#define USE_DIFFUSE_ROUGHNESSMAP":"",e.dispersion?"#define USE_DISPERSION":"",e.retroreflection?"#define USE_RETROREFLECTION":"",e.iridescence?"#define USE_IRIDESCENCE":"",e.iridescenceMap?"#define USE_IRIDESCENCEMAP":"",e.iridescenceThicknessMap?"#define USE_IRIDESCENCE_THICKNESSMAP":"",e.specularMap?"#define USE_SPECULARMAP":"",e.specularColorMap?"#define USE_SPECULAR_COLORMAP":"",e.specularIntensityMap?"#define USE_SPECULAR_INTENSITYMAP":"",e.roughnessMap?"#define USE_ROUGHNESSMAP":"",e.metalnessMap?"#define USE_METALNESSMAP":"",e.alphaMap?"#define USE_ALPHAMAP":"",e.alphaTest?"#define USE_ALPHATEST":"",e.alphaHash?"#define USE_ALPHAHASH":"",e.sheen?"#define USE_SHEEN":"",e.sheenColorMap?"#define USE_SHEEN_COLORMAP":"",e.sheenRoughnessMap?"#define USE_SHEEN_ROUGHNESSMAP":"",e.transmission?"#define USE_TRANSMISSION":"",e.transmissionMap?"#define USE_TRANSMISSIONMAP":"",e.thicknessMap?"#define USE_THICKNESSMAP":"",e.vertexTangents&&e.flatShading===!1?"#define USE_TANGENT":"",e.vertexColors||e.instancingColor?"#define USE_COLOR":"",e.vertexAlphas||e.batchingColor?"#define USE_COLOR_ALPHA":"",e.vertexUv1s?"#define USE_UV1":"",e.vertexUv2s?"#define USE_UV2":"",e.vertexUv3s?"#define USE_UV3":"",e.pointsUvs?"#define USE_POINTS_UV":"",e.gradientMap?"#define USE_GRADIENTMAP":"",e.flatShading?"#define FLAT_SHADED":"",e.doubleSided?"#define DOUBLE_SIDED":"",e.flipSided?"#define FLIP_SIDED":"",e.shadowMapEnabled?"#define USE_SHADOWMAP":"",e.shadowMapEnabled?"#define "+l:"",e.premultipliedAlpha?"#define PREMULTIPLIED_ALPHA":"",e.numLightProbes>0?"#define USE_LIGHT_PROBES":"",e.decodeVideoTexture?"#define DECODE_VIDEO_TEXTURE":"",e.decodeVideoTextureEmissive?"#define DECODE_VIDEO_TEXTURE_EMISSIVE":"",e.logarithmicDepthBuffer?"#define USE_LOGARITHMIC_DEPTH_BUFFER":"",e.reversedDepthBuffer?"#define USE_REVERSED_DEPTH_BUFFER":"","uniform mat4 viewMatrix;","uniform vec3 cameraPosition;","uniform bool isOrthographic;",e.toneMapping!==Cs?"#define TONE_MAPPING":"",e.toneMapping!==Cs?me.tonemapping_pars_fragment:"",e.toneMapping!==Cs?fR("toneMapping",e.toneMapping):"",e.dithering?"#define DITHERING":"",e.opaque?"#define OPAQUE":"",me.colorspace_pars_fragment,uR("linearToOutputTexel",e.outputColorSpace),pR(),e.useDepthPacking?"#define DEPTH_PACKING "+e.depthPacking:"",`
`].filter(oc).join(`
`)),o=Nm(o),o=Xx(o,e),o=qx(o,e),a=Nm(a),a=Xx(a,e),a=qx(a,e),o=jx(o),a=jx(a),e.isRawShaderMaterial!==!0&&(g=`#version 300 es
`,y=[d,"#define attribute in","#define varying out","#define texture2D texture"].join(`
`)+`
`+y,p=["#define varying in",e.glslVersion===xm?"":"layout(location = 0) out highp vec4 pc_fragColor;",e.glslVersion===xm?"":"#define gl_FragColor pc_fragColor","#define gl_FragDepthEXT gl_FragDepth","#define texture2D texture","#define textureCube texture","#define texture2DProj textureProj","#define texture2DLodEXT textureLod","#define texture2DProjLodEXT textureProjLod","#define textureCubeLodEXT textureLod","#define texture2DGradEXT textureGrad","#define texture2DProjGradEXT textureProjGrad","#define textureCubeGradEXT textureGrad"].join(`
`)+`
`+p);let _=g+y+o,w=g+p+a,v=Gx(i,i.VERTEX_SHADER,_),A=Gx(i,i.FRAGMENT_SHADER,w);i.attachShader(m,v),i.attachShader(m,A),e.index0AttributeName!==void 0?i.bindAttribLocation(m,0,e.index0AttributeName):e.hasPositionAttribute===!0&&i.bindAttribLocation(m,0,"position"),i.linkProgram(m);function S(P){if(s.debug.checkShaderErrors){let R=i.getProgramInfoLog(m)||"",O=i.getShaderInfoLog(v)||"",k=i.getShaderInfoLog(A)||"",N=R.trim(),W=O.trim(),z=k.trim(),H=!0,it=!0;if(i.getProgramParameter(m,i.LINK_STATUS)===!1)if(H=!1,typeof s.debug.onShaderError=="function")s.debug.onShaderError(i,m,v,A);else{let Y=Wx(i,v,"vertex"),K=Wx(i,A,"fragment");te("WebGLProgram: Shader Error "+i.getError()+" - VALIDATE_STATUS "+i.getProgramParameter(m,i.VALIDATE_STATUS)+`

Material Name: `+P.name+`
Material Type: `+P.type+`

Program Info Log: `+N+`
`+Y+`
`+K)}else N!==""?Yt("WebGLProgram: Program Info Log:",N):(W===""||z==="")&&(it=!1);it&&(P.diagnostics={runnable:H,programLog:N,vertexShader:{log:W,prefix:y},fragmentShader:{log:z,prefix:p}})}i.deleteShader(v),i.deleteShader(A),x=new Pa(i,m),M=yR(i,m)}let x;this.getUniforms=function(){return x===void 0&&S(this),x};let M;this.getAttributes=function(){return M===void 0&&S(this),M};let L=e.rendererExtensionParallelShaderCompile===!1;return this.isReady=function(){return L===!1&&(L=i.getProgramParameter(m,aR)),L},this.destroy=function(){n.releaseStatesOfProgram(this),i.deleteProgram(m),this.program=void 0},this.type=e.shaderType,this.name=e.shaderName,this.id=lR++,this.cacheKey=t,this.usedTimes=1,this.program=m,this.vertexShader=v,this.fragmentShader=A,this}var RR=0,Dm=class{constructor(){this.shaderCache=new Map,this.materialCache=new Map}update(t,e,n){let i=this._getShaderCacheForMaterial(t);return i.has(e)===!1&&(i.add(e),e.usedTimes++),i.has(n)===!1&&(i.add(n),n.usedTimes++),this}remove(t){let e=this.materialCache.get(t);for(let n of e)n.usedTimes--,n.usedTimes===0&&this.shaderCache.delete(n.code);return this.materialCache.delete(t),this}getVertexShaderStage(t){return this._getShaderStage(t.vertexShader)}getFragmentShaderStage(t){return this._getShaderStage(t.fragmentShader)}dispose(){this.shaderCache.clear(),this.materialCache.clear()}_getShaderCacheForMaterial(t){let e=this.materialCache,n=e.get(t);return n===void 0&&(n=new Set,e.set(t,n)),n}_getShaderStage(t){let e=this.shaderCache,n=e.get(t);return n===void 0&&(n=new Om(t),e.set(t,n)),n}},Om=class{constructor(t){this.id=RR++,this.code=t,this.usedTimes=0}};function PR(s){return s===Ir||s===ec||s===nc}function LR(s,t,e,n,i,r){let o=new ma,a=new Dm,l=new Set,c=[],h=new Map,u=n.logarithmicDepthBuffer,d={MeshDepthMaterial:"depth",MeshDistanceMaterial:"distance",MeshNormalMaterial:"normal",MeshBasicMaterial:"basic",MeshLambertMaterial:"lambert",MeshPhongMaterial:"phong",MeshToonMaterial:"toon",MeshStandardMaterial:"physical",MeshPhysicalMaterial:"physical",MeshMatcapMaterial:"matcap",LineBasicMaterial:"basic",LineDashedMaterial:"dashed",PointsMaterial:"points",ShadowMaterial:"shadow",SpriteMaterial:"sprite"};function f(x){return l.add(x),x===0?"uv":`uv${x}`}function m(x,M,L,P,R,O){let k=P.fog,N=R.geometry,W=x.isMeshStandardMaterial||x.isMeshLambertMaterial||x.isMeshPhongMaterial?P.environment:null,z=x.isMeshStandardMaterial||x.isMeshLambertMaterial&&!x.envMap||x.isMeshPhongMaterial&&!x.envMap,H=t.get(x.envMap||W,z),it=d[x.type],Y=n.precision;x.precision!==null&&(Y=n.getMaxPrecision(x.precision),Y!==x.precision&&Yt("WebGLProgram.getParameters:",x.precision,"not supported, using",Y,"instead."));let K=N.morphAttributes.position||N.morphAttributes.normal||N.morphAttributes.color,tt=K!==void 0?K.length:0,ht=0;N.morphAttributes.position!==void 0&&(ht=1),N.morphAttributes.normal!==void 0&&(ht=2),N.morphAttributes.color!==void 0&&(ht=3);let st,j,rt,nt;if(it){let Ct=_i[it];st=Ct.vertexShader,j=Ct.fragmentShader}else{st=x.vertexShader,j=x.fragmentShader;let Ct=a.getVertexShaderStage(x),ce=a.getFragmentShaderStage(x);a.update(x,Ct,ce),rt=Ct.id,nt=ce.id}let lt=s.getRenderTarget(),gt=s.state.buffers.depth.getReversed(),Ut=R.isInstancedMesh===!0,Kt=R.isBatchedMesh===!0,zt=!!x.map,ge=!!x.matcap,fe=!!H,re=fe&&H.isPMREMTexture===!0,Ze=!!x.aoMap,He=!!x.lightMap,pn=!!x.bumpMap&&x.wireframe===!1,Ue=!!x.normalMap,Ln=!!x.displacementMap,Me=!!x.emissiveMap,Mn=!!x.metalnessMap,rn=!!x.roughnessMap,mn=x.anisotropy>0,G=x.clearcoat>0,Pt=x.diffuseRoughness>0,Zt=x.dispersion>0,ae=x.retroreflectivity>0,wt=x.iridescence>0,ke=x.sheen>0,Wt=x.transmission>0,Jt=mn&&!!x.anisotropyMap,I=G&&!!x.clearcoatMap,T=G&&!!x.clearcoatNormalMap,$=G&&!!x.clearcoatRoughnessMap,mt=Pt&&!!x.diffuseRoughnessMap,dt=wt&&!!x.iridescenceMap,vt=wt&&!!x.iridescenceThicknessMap,bt=ke&&!!x.sheenColorMap,ot=ke&&!!x.sheenRoughnessMap,ct=!!x.specularMap,_t=!!x.specularColorMap,V=!!x.specularIntensityMap,ut=Wt&&!!x.transmissionMap,at=Wt&&!!x.thicknessMap,Tt=!!x.gradientMap,xt=!!x.alphaMap,Mt=x.alphaTest>0,qt=!!x.alphaHash,ee=!!x.extensions,pt=Cs;x.toneMapped&&(lt===null||lt.isXRRenderTarget===!0)&&(pt=s.toneMapping);let Vt=re?H.isCompressedCubeTexture?H.image[0].mipmaps:H.mipmaps:null,ne={shaderID:it,shaderType:x.type,shaderName:x.name,vertexShader:st,fragmentShader:j,defines:x.defines,customVertexShaderID:rt,customFragmentShaderID:nt,isRawShaderMaterial:x.isRawShaderMaterial===!0,glslVersion:x.glslVersion,precision:Y,batching:Kt,batchingColor:Kt&&R._colorsTexture!==null,instancing:Ut,instancingColor:Ut&&R.instanceColor!==null,instancingMorph:Ut&&R.morphTexture!==null,outputColorSpace:lt===null?s.outputColorSpace:lt.isXRRenderTarget===!0?lt.texture.colorSpace:ue.workingColorSpace,alphaToCoverage:!!x.alphaToCoverage,map:zt,matcap:ge,envMap:fe,envMapMode:fe&&H.mapping,envMapPMREM:re,envMapMaxLod:re?Vt.length-1:null,envMapSize:re?Vt[0].width:null,aoMap:Ze,lightMap:He,bumpMap:pn,normalMap:Ue,displacementMap:Ln,emissiveMap:Me,normalMapObjectSpace:Ue&&x.normalMapType===mx,normalMapTangentSpace:Ue&&x.normalMapType===ic,packedNormalMap:Ue&&x.normalMapType===ic&&PR(x.normalMap.format),metalnessMap:Mn,roughnessMap:rn,anisotropy:mn,anisotropyMap:Jt,clearcoat:G,clearcoatMap:I,clearcoatNormalMap:T,clearcoatRoughnessMap:$,diffuseRoughness:Pt,diffuseRoughnessMap:mt,dispersion:Zt,retroreflection:ae,iridescence:wt,iridescenceMap:dt,iridescenceThicknessMap:vt,sheen:ke,sheenColorMap:bt,sheenRoughnessMap:ot,specularMap:ct,specularColorMap:_t,specularIntensityMap:V,transmission:Wt,transmissionMap:ut,thicknessMap:at,gradientMap:Tt,opaque:x.transparent===!1&&x.blending===Ea&&x.alphaToCoverage===!1,alphaMap:xt,alphaTest:Mt,alphaHash:qt,combine:x.combine,mapUv:zt&&f(x.map.channel),aoMapUv:Ze&&f(x.aoMap.channel),lightMapUv:He&&f(x.lightMap.channel),bumpMapUv:pn&&f(x.bumpMap.channel),normalMapUv:Ue&&f(x.normalMap.channel),displacementMapUv:Ln&&f(x.displacementMap.channel),emissiveMapUv:Me&&f(x.emissiveMap.channel),metalnessMapUv:Mn&&f(x.metalnessMap.channel),roughnessMapUv:rn&&f(x.roughnessMap.channel),anisotropyMapUv:Jt&&f(x.anisotropyMap.channel),clearcoatMapUv:I&&f(x.clearcoatMap.channel),clearcoatNormalMapUv:T&&f(x.clearcoatNormalMap.channel),clearcoatRoughnessMapUv:$&&f(x.clearcoatRoughnessMap.channel),diffuseRoughnessMapUv:mt&&f(x.diffuseRoughnessMap.channel),iridescenceMapUv:dt&&f(x.iridescenceMap.channel),iridescenceThicknessMapUv:vt&&f(x.iridescenceThicknessMap.channel),sheenColorMapUv:bt&&f(x.sheenColorMap.channel),sheenRoughnessMapUv:ot&&f(x.sheenRoughnessMap.channel),specularMapUv:ct&&f(x.specularMap.channel),specularColorMapUv:_t&&f(x.specularColorMap.channel),specularIntensityMapUv:V&&f(x.specularIntensityMap.channel),transmissionMapUv:ut&&f(x.transmissionMap.channel),thicknessMapUv:at&&f(x.thicknessMap.channel),alphaMapUv:xt&&f(x.alphaMap.channel),vertexTangents:!!N.attributes.tangent&&(Ue||mn),vertexNormals:!!N.attributes.normal,vertexColors:x.vertexColors,vertexAlphas:x.vertexColors===!0&&!!N.attributes.color&&N.attributes.color.itemSize===4,pointsUvs:R.isPoints===!0&&!!N.attributes.uv&&(zt||xt),fog:!!k,useFog:x.fog===!0,fogExp2:!!k&&k.isFogExp2,flatShading:x.wireframe===!1&&(x.flatShading===!0||N.attributes.normal===void 0&&Ue===!1&&(x.isMeshLambertMaterial||x.isMeshPhongMaterial||x.isMeshStandardMaterial||x.isMeshPhysicalMaterial)),sizeAttenuation:x.sizeAttenuation===!0,logarithmicDepthBuffer:u,reversedDepthBuffer:gt,skinning:R.isSkinnedMesh===!0,hasPositionAttribute:N.attributes.position!==void 0,morphTargets:N.morphAttributes.position!==void 0,morphNormals:N.morphAttributes.normal!==void 0,morphColors:N.morphAttributes.color!==void 0,morphTargetsCount:tt,morphTextureStride:ht,numSunLights:M.sun.length,numDirLights:M.directional.length,numPointLights:M.point.length,numSpotLights:M.spot.length,numSpotLightMaps:M.spotLightMap.length,numRectAreaLights:M.rectArea.length,numHemiLights:M.hemi.length,numSunLightShadows:M.sunShadowMap.length,numDirLightShadows:M.directionalShadowMap.length,numPointLightShadows:M.pointShadowMap.length,numSpotLightShadows:M.spotShadowMap.length,numSpotLightShadowsWithMaps:M.numSpotLightShadowsWithMaps,numLightProbes:M.numLightProbes,numLightProbeGrids:O.filter(Ct=>Ct.texture!==null).length,numClippingPlanes:r.numPlanes,numClipIntersection:r.numIntersection,dithering:x.dithering,shadowMapEnabled:s.shadowMap.enabled&&L.length>0,shadowMapType:s.shadowMap.type,toneMapping:pt,decodeVideoTexture:zt&&x.map.isVideoTexture===!0&&ue.getTransfer(x.map.colorSpace)===Ne,decodeVideoTextureEmissive:Me&&x.emissiveMap.isVideoTexture===!0&&ue.getTransfer(x.emissiveMap.colorSpace)===Ne,premultipliedAlpha:x.premultipliedAlpha,doubleSided:x.side===yi,flipSided:x.side===jn,useDepthPacking:x.depthPacking>=0,depthPacking:x.depthPacking||0,index0AttributeName:x.index0AttributeName,extensionClipCullDistance:ee&&x.extensions.clipCullDistance===!0&&e.has("WEBGL_clip_cull_distance"),extensionMultiDraw:(ee&&x.extensions.multiDraw===!0||Kt)&&e.has("WEBGL_multi_draw"),rendererExtensionParallelShaderCompile:e.has("KHR_parallel_shader_compile"),customProgramCacheKey:x.customProgramCacheKey()};return ne.vertexUv1s=l.has(1),ne.vertexUv2s=l.has(2),ne.vertexUv3s=l.has(3),l.clear(),ne}function y(x){let M=[];if(x.shaderID?M.push(x.shaderID):(M.push(x.customVertexShaderID),M.push(x.customFragmentShaderID)),x.defines!==void 0)for(let L in x.defines)M.push(L),M.push(x.defines[L]);return x.isRawShaderMaterial===!1&&(p(M,x),g(M,x),M.push(s.outputColorSpace)),M.push(x.customProgramCacheKey),M.join()}function p(x,M){x.push(M.precision),x.push(M.outputColorSpace),x.push(M.envMapMode),x.push(M.envMapPMREM),x.push(M.envMapMaxLod),x.push(M.envMapSize),x.push(M.mapUv),x.push(M.alphaMapUv),x.push(M.lightMapUv),x.push(M.aoMapUv),x.push(M.bumpMapUv),x.push(M.normalMapUv),x.push(M.displacementMapUv),x.push(M.emissiveMapUv),x.push(M.metalnessMapUv),x.push(M.roughnessMapUv),x.push(M.anisotropyMapUv),x.push(M.clearcoatMapUv),x.push(M.clearcoatNormalMapUv),x.push(M.clearcoatRoughnessMapUv),x.push(M.diffuseRoughnessMapUv),x.push(M.iridescenceMapUv),x.push(M.iridescenceThicknessMapUv),x.push(M.sheenColorMapUv),x.push(M.sheenRoughnessMapUv),x.push(M.specularMapUv),x.push(M.specularColorMapUv),x.push(M.specularIntensityMapUv),x.push(M.transmissionMapUv),x.push(M.thicknessMapUv),x.push(M.combine),x.push(M.fogExp2),x.push(M.sizeAttenuation),x.push(M.morphTargetsCount),x.push(M.numSunLights),x.push(M.numDirLights),x.push(M.numPointLights),x.push(M.numSpotLights),x.push(M.numSpotLightMaps),x.push(M.numHemiLights),x.push(M.numRectAreaLights),x.push(M.numSunLightShadows),x.push(M.numDirLightShadows),x.push(M.numPointLightShadows),x.push(M.numSpotLightShadows),x.push(M.numSpotLightShadowsWithMaps),x.push(M.numLightProbes),x.push(M.numLightProbeGrids),x.push(M.shadowMapType),x.push(M.toneMapping),x.push(M.numClippingPlanes),x.push(M.numClipIntersection),x.push(M.depthPacking)}function g(x,M){o.disableAll(),M.instancing&&o.enable(0),M.instancingColor&&o.enable(1),M.instancingMorph&&o.enable(2),M.matcap&&o.enable(3),M.envMap&&o.enable(4),M.normalMapObjectSpace&&o.enable(5),M.normalMapTangentSpace&&o.enable(6),M.clearcoat&&o.enable(7),M.iridescence&&o.enable(8),M.alphaTest&&o.enable(9),M.vertexColors&&o.enable(10),M.vertexAlphas&&o.enable(11),M.vertexUv1s&&o.enable(12),M.vertexUv2s&&o.enable(13),M.vertexUv3s&&o.enable(14),M.vertexTangents&&o.enable(15),M.anisotropy&&o.enable(16),M.alphaHash&&o.enable(17),M.batching&&o.enable(18),M.dispersion&&o.enable(19),M.retroreflection&&o.enable(24),M.diffuseRoughness&&o.enable(25),M.batchingColor&&o.enable(20),M.gradientMap&&o.enable(21),M.packedNormalMap&&o.enable(22),M.vertexNormals&&o.enable(23),x.push(o.mask),o.disableAll(),M.fog&&o.enable(0),M.useFog&&o.enable(1),M.flatShading&&o.enable(2),M.logarithmicDepthBuffer&&o.enable(3),M.reversedDepthBuffer&&o.enable(4),M.skinning&&o.enable(5),M.morphTargets&&o.enable(6),M.morphNormals&&o.enable(7),M.morphColors&&o.enable(8),M.premultipliedAlpha&&o.enable(9),M.shadowMapEnabled&&o.enable(10),M.doubleSided&&o.enable(11),M.flipSided&&o.enable(12),M.useDepthPacking&&o.enable(13),M.dithering&&o.enable(14),M.transmission&&o.enable(15),M.sheen&&o.enable(16),M.opaque&&o.enable(17),M.pointsUvs&&o.enable(18),M.decodeVideoTexture&&o.enable(19),M.decodeVideoTextureEmissive&&o.enable(20),M.alphaToCoverage&&o.enable(21),M.numLightProbeGrids>0&&o.enable(22),M.hasPositionAttribute&&o.enable(23),x.push(o.mask)}function _(x){let M=d[x.type],L;if(M){let P=_i[M];L=sc.clone(P.uniforms)}else L=x.uniforms;return L}function w(x,M){let L=h.get(M);return L!==void 0?++L.usedTimes:(L=new CR(s,M,x,i),c.push(L),h.set(M,L)),L}function v(x){if(--x.usedTimes===0){let M=c.indexOf(x);c[M]=c[c.length-1],c.pop(),h.delete(x.cacheKey),x.destroy()}}function A(x){a.remove(x)}function S(){a.dispose()}return{getParameters:m,getProgramCacheKey:y,getUniforms:_,acquireProgram:w,releaseProgram:v,releaseShaderCache:A,programs:c,dispose:S}}function IR(){let s=new WeakMap;function t(o){return s.has(o)}function e(o){let a=s.get(o);return a===void 0&&(a={},s.set(o,a)),a}function n(o){s.delete(o)}function i(o,a,l){s.get(o)[a]=l}function r(){s=new WeakMap}return{has:t,get:e,remove:n,update:i,dispose:r}}function NR(s,t){return s.groupOrder!==t.groupOrder?s.groupOrder-t.groupOrder:s.renderOrder!==t.renderOrder?s.renderOrder-t.renderOrder:s.material.id!==t.material.id?s.material.id-t.material.id:s.materialVariant!==t.materialVariant?s.materialVariant-t.materialVariant:s.z!==t.z?s.z-t.z:s.id-t.id}function $x(s,t){return s.groupOrder!==t.groupOrder?s.groupOrder-t.groupOrder:s.renderOrder!==t.renderOrder?s.renderOrder-t.renderOrder:s.z!==t.z?t.z-s.z:s.id-t.id}function Jx(){let s=[],t=0,e=[],n=[],i=[];function r(){t=0,e.length=0,n.length=0,i.length=0}function o(d){let f=0;return d.isInstancedMesh&&(f+=2),d.isSkinnedMesh&&(f+=1),f}function a(d,f,m,y,p,g){let _=s[t];return _===void 0?(_={id:d.id,object:d,geometry:f,material:m,materialVariant:o(d),groupOrder:y,renderOrder:d.renderOrder,z:p,group:g},s[t]=_):(_.id=d.id,_.object=d,_.geometry=f,_.material=m,_.materialVariant=o(d),_.groupOrder=y,_.renderOrder=d.renderOrder,_.z=p,_.group=g),t++,_}function l(d,f,m,y,p,g,_){_.reversedDepth===!0&&(p=-p);let w=a(d,f,m,y,p,g);m.transmission>0?n.push(w):m.transparent===!0?i.push(w):e.push(w)}function c(d,f,m,y,p,g){let _=a(d,f,m,y,p,g);m.transmission>0?n.unshift(_):m.transparent===!0?i.unshift(_):e.unshift(_)}function h(d,f){e.length>1&&e.sort(d||NR),n.length>1&&n.sort(f||$x),i.length>1&&i.sort(f||$x)}function u(){for(let d=t,f=s.length;d<f;d++){let m=s[d];if(m.id===null)break;m.id=null,m.object=null,m.geometry=null,m.material=null,m.group=null}}return{opaque:e,transmissive:n,transparent:i,init:r,push:l,unshift:c,finish:u,sort:h}}function DR(){let s=new WeakMap;function t(n,i){let r=s.get(n),o;return r===void 0?(o=new Jx,s.set(n,[o])):i>=r.length?(o=new Jx,r.push(o)):o=r[i],o}function e(){s=new WeakMap}return{get:t,dispose:e}}function OR(){let s={};return{get:function(t){if(s[t.id]!==void 0)return s[t.id];let e;switch(t.type){case"SunLight":case"DirectionalLight":e={direction:new F,color:new Rt};break;case"SpotLight":e={position:new F,direction:new F,color:new Rt,distance:0,coneCos:0,penumbraCos:0,decay:0};break;case"PointLight":e={position:new F,color:new Rt,distance:0,decay:0};break;case"HemisphereLight":e={direction:new F,skyColor:new Rt,groundColor:new Rt};break;case"RectAreaLight":e={color:new Rt,position:new F,halfWidth:new F,halfHeight:new F};break}return s[t.id]=e,e}}}function FR(){let s={};return{get:function(t){if(s[t.id]!==void 0)return s[t.id];let e;switch(t.type){case"SunLight":case"DirectionalLight":e={shadowIntensity:1,shadowBias:0,shadowNormalBias:0,shadowRadius:1,shadowMapSize:new Xt};break;case"SpotLight":e={shadowIntensity:1,shadowBias:0,shadowNormalBias:0,shadowRadius:1,shadowMapSize:new Xt};break;case"PointLight":e={shadowIntensity:1,shadowBias:0,shadowNormalBias:0,shadowRadius:1,shadowMapSize:new Xt,shadowCameraNear:1,shadowCameraFar:1e3};break}return s[t.id]=e,e}}}var UR=0;function BR(s,t){return(t.castShadow?2:0)-(s.castShadow?2:0)+(t.map?1:0)-(s.map?1:0)}function kR(s){let t=new OR,e=FR(),n={version:0,hash:{sunLength:-1,directionalLength:-1,pointLength:-1,spotLength:-1,rectAreaLength:-1,hemiLength:-1,numSunShadows:-1,numDirectionalShadows:-1,numPointShadows:-1,numSpotShadows:-1,numSpotMaps:-1,numLightProbes:-1},ambient:[0,0,0],probe:[],sun:[],sunShadow:[],sunShadowMap:[],sunShadowMatrix:[],sunShadowCascade:[],directional:[],directionalShadow:[],directionalShadowMap:[],directionalShadowMatrix:[],spot:[],spotLightMap:[],spotShadow:[],spotShadowMap:[],spotLightMatrix:[],rectArea:[],rectAreaLTC1:null,rectAreaLTC2:null,point:[],pointShadow:[],pointShadowMap:[],pointShadowMatrix:[],hemi:[],numSpotLightShadowsWithMaps:0,numLightProbes:0};for(let c=0;c<9;c++)n.probe.push(new F);let i=new F,r=new Nt,o=new Nt;function a(c){let h=0,u=0,d=0;for(let O=0;O<9;O++)n.probe[O].set(0,0,0);let f=0,m=0,y=0,p=0,g=0,_=0,w=0,v=0,A=0,S=0,x=0,M=0,L=0,P=0;c.sort(BR);for(let O=0,k=c.length;O<k;O++){let N=c[O],W=N.color,z=N.intensity,H=N.distance,it=null;if(N.shadow&&N.shadow.map&&(N.shadow.map.texture.format===Ir?it=N.shadow.map.texture:it=N.shadow.map.depthTexture||N.shadow.map.texture),N.isAmbientLight)h+=W.r*z,u+=W.g*z,d+=W.b*z;else if(N.isLightProbe){for(let Y=0;Y<9;Y++)n.probe[Y].addScaledVector(N.sh.coefficients[Y],z);P++}else if(N.isSunLight){let Y=t.get(N);if(Y.color.copy(N.color).multiplyScalar(N.intensity),N.castShadow){let K=N.shadow,tt=e.get(N);tt.shadowIntensity=K.intensity,tt.shadowBias=K.bias,tt.shadowNormalBias=K.normalBias,tt.shadowRadius=K.radius,tt.shadowMapSize.copy(K.mapSize).multiply(K.getFrameExtents()),n.sunShadow[m]=tt,n.sunShadowMap[m]=it;let ht=K.getViewportCount();for(let st=0;st<ht;st++)n.sunShadowMatrix[y+st]=K.getMatrix(st),n.sunShadowCascade[y+st]=K._cascadeData[st];y+=ht,m++}n.sun[f]=Y,f++}else if(N.isDirectionalLight){let Y=t.get(N);if(Y.color.copy(N.color).multiplyScalar(N.intensity),N.castShadow){let K=N.shadow,tt=e.get(N);tt.shadowIntensity=K.intensity,tt.shadowBias=K.bias,tt.shadowNormalBias=K.normalBias,tt.shadowRadius=K.radius,tt.shadowMapSize=K.mapSize,n.directionalShadow[p]=tt,n.directionalShadowMap[p]=it,n.directionalShadowMatrix[p]=N.shadow.matrix,A++}n.directional[p]=Y,p++}else if(N.isSpotLight){let Y=t.get(N);Y.position.setFromMatrixPosition(N.matrixWorld),Y.color.copy(W).multiplyScalar(z),Y.distance=H,Y.coneCos=Math.cos(N.angle),Y.penumbraCos=Math.cos(N.angle*(1-N.penumbra)),Y.decay=N.decay,n.spot[_]=Y;let K=N.shadow;if(N.map&&(n.spotLightMap[M]=N.map,M++,K.updateMatrices(N),N.castShadow&&L++),n.spotLightMatrix[_]=K.matrix,N.castShadow){let tt=e.get(N);tt.shadowIntensity=K.intensity,tt.shadowBias=K.bias,tt.shadowNormalBias=K.normalBias,tt.shadowRadius=K.radius,tt.shadowMapSize=K.mapSize,n.spotShadow[_]=tt,n.spotShadowMap[_]=it,x++}_++}else if(N.isRectAreaLight){let Y=t.get(N);Y.color.copy(W).multiplyScalar(z),Y.halfWidth.set(N.width*.5,0,0),Y.halfHeight.set(0,N.height*.5,0),n.rectArea[w]=Y,w++}else if(N.isPointLight){let Y=t.get(N);if(Y.color.copy(N.color).multiplyScalar(N.intensity),Y.distance=N.distance,Y.decay=N.decay,N.castShadow){let K=N.shadow,tt=e.get(N);tt.shadowIntensity=K.intensity,tt.shadowBias=K.bias,tt.shadowNormalBias=K.normalBias,tt.shadowRadius=K.radius,tt.shadowMapSize=K.mapSize,tt.shadowCameraNear=K.camera.near,tt.shadowCameraFar=K.camera.far,n.pointShadow[g]=tt,n.pointShadowMap[g]=it,n.pointShadowMatrix[g]=N.shadow.matrix,S++}n.point[g]=Y,g++}else if(N.isHemisphereLight){let Y=t.get(N);Y.skyColor.copy(N.color).multiplyScalar(z),Y.groundColor.copy(N.groundColor).multiplyScalar(z),n.hemi[v]=Y,v++}}w>0&&(s.has("OES_texture_float_linear")===!0?(n.rectAreaLTC1=Lt.LTC_FLOAT_1,n.rectAreaLTC2=Lt.LTC_FLOAT_2):(n.rectAreaLTC1=Lt.LTC_HALF_1,n.rectAreaLTC2=Lt.LTC_HALF_2)),n.ambient[0]=h,n.ambient[1]=u,n.ambient[2]=d;let R=n.hash;(R.sunLength!==f||R.directionalLength!==p||R.pointLength!==g||R.spotLength!==_||R.rectAreaLength!==w||R.hemiLength!==v||R.numSunShadows!==m||R.numDirectionalShadows!==A||R.numPointShadows!==S||R.numSpotShadows!==x||R.numSpotMaps!==M||R.numLightProbes!==P)&&(n.sun.length=f,n.directional.length=p,n.spot.length=_,n.rectArea.length=w,n.point.length=g,n.hemi.length=v,n.sunShadow.length=m,n.sunShadowMap.length=m,n.sunShadowMatrix.length=y,n.sunShadowCascade.length=y,n.directionalShadow.length=A,n.directionalShadowMap.length=A,n.directionalShadowMatrix.length=A,n.pointShadow.length=S,n.pointShadowMap.length=S,n.pointShadowMatrix.length=S,n.spotShadow.length=x,n.spotShadowMap.length=x,n.spotLightMatrix.length=x+M-L,n.spotLightMap.length=M,n.numSpotLightShadowsWithMaps=L,n.numLightProbes=P,R.sunLength=f,R.directionalLength=p,R.pointLength=g,R.spotLength=_,R.rectAreaLength=w,R.hemiLength=v,R.numSunShadows=m,R.numDirectionalShadows=A,R.numPointShadows=S,R.numSpotShadows=x,R.numSpotMaps=M,R.numLightProbes=P,n.version=UR++)}function l(c,h){let u=0,d=0,f=0,m=0,y=0,p=0,g=h.matrixWorldInverse;for(let _=0,w=c.length;_<w;_++){let v=c[_];if(v.isSunLight){let A=n.sun[u];A.direction.setFromMatrixPosition(v.matrixWorld),A.direction.transformDirection(g),u++}else if(v.isDirectionalLight){let A=n.directional[d];A.direction.setFromMatrixPosition(v.matrixWorld),i.setFromMatrixPosition(v.target.matrixWorld),A.direction.sub(i),A.direction.transformDirection(g),d++}else if(v.isSpotLight){let A=n.spot[m];A.position.setFromMatrixPosition(v.matrixWorld),A.position.applyMatrix4(g),A.direction.setFromMatrixPosition(v.matrixWorld),i.setFromMatrixPosition(v.target.matrixWorld),A.direction.sub(i),A.direction.transformDirection(g),m++}else if(v.isRectAreaLight){let A=n.rectArea[y];A.position.setFromMatrixPosition(v.matrixWorld),A.position.applyMatrix4(g),o.identity(),r.copy(v.matrixWorld),r.premultiply(g),o.extractRotation(r),A.halfWidth.set(v.width*.5,0,0),A.halfHeight.set(0,v.height*.5,0),A.halfWidth.applyMatrix4(o),A.halfHeight.applyMatrix4(o),y++}else if(v.isPointLight){let A=n.point[f];A.position.setFromMatrixPosition(v.matrixWorld),A.position.applyMatrix4(g),f++}else if(v.isHemisphereLight){let A=n.hemi[p];A.direction.setFromMatrixPosition(v.matrixWorld),A.direction.transformDirection(g),p++}}}return{setup:a,setupView:l,state:n}}function Kx(s){let t=new kR(s),e=[],n=[],i=[];function r(u){h.camera=u,e.length=0,n.length=0,i.length=0}function o(u){u.isLightProbeGrid?i.push(u):e.push(u)}function a(u){n.push(u)}function l(){t.setup(e),i.sort((u,d)=>u.priority-d.priority||u.id-d.id)}function c(u){t.setupView(e,u)}let h={lightsArray:e,shadowsArray:n,lightProbeGridArray:i,camera:null,lights:t,transmissionRenderTarget:{},textureUnits:0};return{init:r,state:h,setupLights:l,setupLightsView:c,pushLight:o,pushShadow:a}}function zR(s){let t=new WeakMap;function e(i,r=0){let o=t.get(i),a;return o===void 0?(a=new Kx(s),t.set(i,[a])):r>=o.length?(a=new Kx(s),o.push(a)):a=o[r],a}function n(){t=new WeakMap}return{get:e,dispose:n}}var VR=`void main() {
	gl_Position = vec4( position, 1.0 );
}`,GR=`uniform sampler2D shadow_pass;
uniform vec2 resolution;
uniform float radius;
void main() {
	const float samples = float( VSM_SAMPLES );
	float mean = 0.0;
	float squared_mean = 0.0;
	float uvStride = samples <= 1.0 ? 0.0 : 2.0 / ( samples - 1.0 );
	float uvStart = samples <= 1.0 ? 0.0 : - 1.0;
	for ( float i = 0.0; i < samples; i ++ ) {
		float uvOffset = uvStart + i * uvStride;
		#ifdef HORIZONTAL_PASS
			vec2 distribution = texture2D( shadow_pass, ( gl_FragCoord.xy + vec2( uvOffset, 0.0 ) * radius ) / resolution ).rg;
			mean += distribution.x;
			squared_mean += distribution.y * distribution.y + distribution.x * distribution.x;
		#else
			float depth = texture2D( shadow_pass, ( gl_FragCoord.xy + vec2( 0.0, uvOffset ) * radius ) / resolution ).r;
			mean += depth;
			squared_mean += depth * depth;
		#endif
	}
	mean = mean / samples;
	squared_mean = squared_mean / samples;
	float std_dev = sqrt( max( 0.0, squared_mean - mean * mean ) );
	gl_FragColor = vec4( mean, std_dev, 0.0, 1.0 );
}`,HR=[new F(1,0,0),new F(-1,0,0),new F(0,1,0),new F(0,-1,0),new F(0,0,1),new F(0,0,-1)],WR=[new F(0,-1,0),new F(0,-1,0),new F(0,0,1),new F(0,0,-1),new F(0,-1,0),new F(0,-1,0)],Zx=new Nt,rc=new F,Rm=new F;function XR(s,t,e){let n=new Er,i=new Xt,r=new Xt,o=new Se,a=new au,l=new lu,c={},h=e.maxTextureSize,u={[Es]:jn,[jn]:Es,[yi]:yi},d=new vi({defines:{VSM_SAMPLES:8},uniforms:{shadow_pass:{value:null},resolution:{value:new Xt},radius:{value:4}},vertexShader:VR,fragmentShader:GR}),f=d.clone();f.defines.HORIZONTAL_PASS=1;let m=new Ae;m.setAttribute("position",new hn(new Float32Array([-1,-1,.5,3,-1,.5,-1,3,.5]),3));let y=new de(m,d),p=this;this.enabled=!1,this.autoUpdate=!0,this.needsUpdate=!1,this.type=mo;let g=this.type;this.render=function(S,x,M){if(p.enabled===!1||p.autoUpdate===!1&&p.needsUpdate===!1||S.length===0)return;this.type===W_&&(Yt("WebGLShadowMap: PCFSoftShadowMap has been removed. Using PCFShadowMap instead."),this.type=mo);let L=s.getRenderTarget(),P=s.getActiveCubeFace(),R=s.getActiveMipmapLevel(),O=s.state;O.setBlending(go),O.buffers.depth.getReversed()===!0?O.buffers.color.setClear(0,0,0,0):O.buffers.color.setClear(1,1,1,1),O.buffers.depth.setTest(!0),O.setScissorTest(!1);let k=g!==this.type;k&&x.traverse(function(N){N.material&&(Array.isArray(N.material)?N.material.forEach(W=>W.needsUpdate=!0):N.material.needsUpdate=!0)});for(let N=0,W=S.length;N<W;N++){let z=S[N],H=z.shadow;if(H===void 0){Yt("WebGLShadowMap:",z,"has no shadow.");continue}if(H.autoUpdate===!1&&H.needsUpdate===!1)continue;i.copy(H.mapSize);let it=H.getFrameExtents();i.multiply(it),r.copy(H.mapSize),(i.x>h||i.y>h)&&(i.x>h&&(r.x=Math.floor(h/it.x),i.x=r.x*it.x,H.mapSize.x=r.x),i.y>h&&(r.y=Math.floor(h/it.y),i.y=r.y*it.y,H.mapSize.y=r.y));let Y=s.state.buffers.depth.getReversed();if(H.camera._reversedDepth=Y,H.map===null||k===!0){if(H.map!==null&&(H.map.depthTexture!==null&&(H.map.depthTexture.dispose(),H.map.depthTexture=null),H.map.dispose()),this.type===Aa){if(z.isPointLight){Yt("WebGLShadowMap: VSM shadow maps are not supported for PointLights. Use PCF or BasicShadowMap instead.");continue}H.map=new Fi(i.x,i.y,{format:Ir,type:ds,minFilter:Bn,magFilter:Bn,generateMipmaps:!1}),H.map.texture.name=z.name+".shadowMap",H.map.depthTexture=new Qs(i.x,i.y,ki),H.map.depthTexture.name=z.name+".shadowMapDepth",H.map.depthTexture.format=Ks,H.map.depthTexture.compareFunction=null,H.map.depthTexture.minFilter=kn,H.map.depthTexture.magFilter=kn}else z.isPointLight?(H.map=new ac(i.x),H.map.depthTexture=new Pl(i.x,us)):(H.map=new Fi(i.x,i.y),H.map.depthTexture=new Qs(i.x,i.y,us)),H.map.depthTexture.name=z.name+".shadowMap",H.map.depthTexture.format=Ks,this.type===mo?(H.map.depthTexture.compareFunction=Y?gm:mm,H.map.depthTexture.minFilter=Bn,H.map.depthTexture.magFilter=Bn):(H.map.depthTexture.compareFunction=null,H.map.depthTexture.minFilter=kn,H.map.depthTexture.magFilter=kn);H.camera.updateProjectionMatrix()}H.map.isWebGLCubeRenderTarget!==!0&&(H.map.width!==i.x||H.map.height!==i.y)&&H.map.setSize(i.x,i.y);let K=H.map.isWebGLCubeRenderTarget?6:H.getViewportCount();z.isPointLight!==!0&&H.updateMatrices(z,M);let tt=(H.camera.layers.mask&4294967294)!==0?H.camera.layers:M.layers;for(let ht=0;ht<K;ht++){let st=H.getCamera(ht);if(z.isPointLight){let j=H.camera,rt=H.matrix,nt=z.distance||j.far;nt!==j.far&&(j.far=nt,j.updateProjectionMatrix()),rc.setFromMatrixPosition(z.matrixWorld),j.position.copy(rc),Rm.copy(j.position),Rm.add(HR[ht]),j.up.copy(WR[ht]),j.lookAt(Rm),j.updateMatrixWorld(),rt.makeTranslation(-rc.x,-rc.y,-rc.z),Zx.multiplyMatrices(j.projectionMatrix,j.matrixWorldInverse),H._frustum.setFromProjectionMatrix(Zx,j.coordinateSystem,j.reversedDepth)}if(H.map.isWebGLCubeRenderTarget)s.setRenderTarget(H.map,ht),s.clear();else{ht===0&&(s.setRenderTarget(H.map),s.clear());let j=H.getViewport(ht);o.set(r.x*j.x,r.y*j.y,r.x*j.z,r.y*j.w),O.viewport(o)}n=H.getFrustum(ht),v(x,M,st,z,tt,this.type)}H.isPointLightShadow!==!0&&this.type===Aa&&_(H,M),H.needsUpdate=!1}g=this.type,p.needsUpdate=!1,s.setRenderTarget(L,P,R)};function _(S,x){let M=t.update(y);d.defines.VSM_SAMPLES!==S.blurSamples&&(d.defines.VSM_SAMPLES=S.blurSamples,f.defines.VSM_SAMPLES=S.blurSamples,d.needsUpdate=!0,f.needsUpdate=!0),S.mapPass===null?S.mapPass=new Fi(i.x,i.y,{format:Ir,type:ds}):(S.mapPass.width!==S.map.width||S.mapPass.height!==S.map.height)&&S.mapPass.setSize(S.map.width,S.map.height),d.uniforms.shadow_pass.value=S.map.depthTexture,d.uniforms.resolution.value.set(S.map.width,S.map.height),d.uniforms.radius.value=S.radius,s.setRenderTarget(S.mapPass),s.clear(),s.renderBufferDirect(x,null,M,d,y,null),f.uniforms.shadow_pass.value=S.mapPass.texture,f.uniforms.resolution.value.set(S.map.width,S.map.height),f.uniforms.radius.value=S.radius,s.setRenderTarget(S.map),s.clear(),s.renderBufferDirect(x,null,M,f,y,null)}function w(S,x,M,L){let P=null,R=M.isPointLight===!0?S.customDistanceMaterial:S.customDepthMaterial;if(R!==void 0)P=R;else if(P=M.isPointLight===!0?l:a,s.localClippingEnabled&&x.clipShadows===!0&&Array.isArray(x.clippingPlanes)&&x.clippingPlanes.length!==0||x.displacementMap&&x.displacementScale!==0||x.alphaMap&&x.alphaTest>0||x.map&&x.alphaTest>0||x.alphaToCoverage===!0){let O=P.uuid,k=x.uuid,N=c[O];N===void 0&&(N={},c[O]=N);let W=N[k];W===void 0&&(W=P.clone(),N[k]=W,x.addEventListener("dispose",A)),P=W}if(P.visible=x.visible,P.wireframe=x.wireframe,L===Aa?P.side=x.shadowSide!==null?x.shadowSide:x.side:P.side=x.shadowSide!==null?x.shadowSide:u[x.side],P.alphaMap=x.alphaMap,P.alphaTest=x.alphaToCoverage===!0?.5:x.alphaTest,P.map=x.map,P.clipShadows=x.clipShadows,P.clippingPlanes=x.clippingPlanes,P.clipIntersection=x.clipIntersection,P.displacementMap=x.displacementMap,P.displacementScale=x.displacementScale,P.displacementBias=x.displacementBias,P.wireframeLinewidth=x.wireframeLinewidth,P.linewidth=x.linewidth,M.isPointLight===!0&&P.isMeshDistanceMaterial===!0){let O=s.properties.get(P);O.light=M}return P}function v(S,x,M,L,P,R){if(S.visible===!1)return;if(S.layers.test(P)&&(S.isMesh||S.isLine||S.isPoints)&&(S.castShadow||S.receiveShadow&&R===Aa)&&(!S.frustumCulled||S.intersectsFrustum(n))){S.modelViewMatrix.multiplyMatrices(M.matrixWorldInverse,S.matrixWorld);let N=t.update(S),W=S.material;if(Array.isArray(W)){let z=N.groups;for(let H=0,it=z.length;H<it;H++){let Y=z[H],K=W[Y.materialIndex];if(K&&K.visible){let tt=w(S,K,L,R);S.onBeforeShadow(s,S,x,M,N,tt,Y),s.renderBufferDirect(M,null,N,tt,S,Y),S.onAfterShadow(s,S,x,M,N,tt,Y)}}}else if(W.visible){let z=w(S,W,L,R);S.onBeforeShadow(s,S,x,M,N,z,null),s.renderBufferDirect(M,null,N,z,S,null),S.onAfterShadow(s,S,x,M,N,z,null)}}let k=S.children;for(let N=0,W=k.length;N<W;N++)v(k[N],x,M,L,P,R)}function A(S){S.target.removeEventListener("dispose",A);for(let M in c){let L=c[M],P=S.target.uuid;P in L&&(L[P].dispose(),delete L[P])}}}function qR(s,t){function e(){let V=!1,ut=new Se,at=null,Tt=new Se(0,0,0,0);return{setMask:function(xt){at!==xt&&!V&&(s.colorMask(xt,xt,xt,xt),at=xt)},setLocked:function(xt){V=xt},setClear:function(xt,Mt,qt,ee,pt){pt===!0&&(xt*=ee,Mt*=ee,qt*=ee),ut.set(xt,Mt,qt,ee),Tt.equals(ut)===!1&&(s.clearColor(xt,Mt,qt,ee),Tt.copy(ut))},reset:function(){V=!1,at=null,Tt.set(-1,0,0,0)}}}function n(){let V=!1,ut=!1,at=null,Tt=null,xt=null;return{setReversed:function(Mt){if(ut!==Mt){let qt=t.get("EXT_clip_control");Mt?qt.clipControlEXT(qt.LOWER_LEFT_EXT,qt.ZERO_TO_ONE_EXT):qt.clipControlEXT(qt.LOWER_LEFT_EXT,qt.NEGATIVE_ONE_TO_ONE_EXT),ut=Mt;let ee=xt;xt=null,this.setClear(ee)}},getReversed:function(){return ut},setTest:function(Mt){Mt?gt(s.DEPTH_TEST):Ut(s.DEPTH_TEST)},setMask:function(Mt){at!==Mt&&!V&&(s.depthMask(Mt),at=Mt)},setFunc:function(Mt){if(ut&&(Mt=Tx[Mt]),Tt!==Mt){switch(Mt){case Wh:s.depthFunc(s.NEVER);break;case Xh:s.depthFunc(s.ALWAYS);break;case qh:s.depthFunc(s.LESS);break;case ha:s.depthFunc(s.LEQUAL);break;case jh:s.depthFunc(s.EQUAL);break;case Yh:s.depthFunc(s.GEQUAL);break;case $h:s.depthFunc(s.GREATER);break;case Jh:s.depthFunc(s.NOTEQUAL);break;default:s.depthFunc(s.LEQUAL)}Tt=Mt}},setLocked:function(Mt){V=Mt},setClear:function(Mt){xt!==Mt&&(xt=Mt,ut&&(Mt=1-Mt),s.clearDepth(Mt))},reset:function(){V=!1,at=null,Tt=null,xt=null,ut=!1}}}function i(){let V=!1,ut=null,at=null,Tt=null,xt=null,Mt=null,qt=null,ee=null,pt=null;return{setTest:function(Vt){V||(Vt?gt(s.STENCIL_TEST):Ut(s.STENCIL_TEST))},setMask:function(Vt){ut!==Vt&&!V&&(s.stencilMask(Vt),ut=Vt)},setFunc:function(Vt,ne,Ct){(at!==Vt||Tt!==ne||xt!==Ct)&&(s.stencilFunc(Vt,ne,Ct),at=Vt,Tt=ne,xt=Ct)},setOp:function(Vt,ne,Ct){(Mt!==Vt||qt!==ne||ee!==Ct)&&(s.stencilOp(Vt,ne,Ct),Mt=Vt,qt=ne,ee=Ct)},setLocked:function(Vt){V=Vt},setClear:function(Vt){pt!==Vt&&(s.clearStencil(Vt),pt=Vt)},reset:function(){V=!1,ut=null,at=null,Tt=null,xt=null,Mt=null,qt=null,ee=null,pt=null}}}let r=new e,o=new n,a=new i,l={},c=new WeakMap,h={},u={},d={},f=new WeakMap,m=[],y=null,p=!1,g=null,_=null,w=null,v=null,A=null,S=null,x=null,M=new Rt(0,0,0),L=0,P=!1,R=null,O=null,k=null,N=null,W=null,z=s.getParameter(s.MAX_COMBINED_TEXTURE_IMAGE_UNITS),H=!1,it=0,Y=s.getParameter(s.VERSION);Y.indexOf("WebGL")!==-1?(it=parseFloat(/^WebGL (\d)/.exec(Y)[1]),H=it>=1):Y.indexOf("OpenGL ES")!==-1&&(it=parseFloat(/^OpenGL ES (\d)/.exec(Y)[1]),H=it>=2);let K=null,tt={},ht=s.getParameter(s.SCISSOR_BOX),st=s.getParameter(s.VIEWPORT),j=new Se().fromArray(ht),rt=new Se().fromArray(st);function nt(V,ut,at,Tt){let xt=new Uint8Array(4),Mt=s.createTexture();s.bindTexture(V,Mt),s.texParameteri(V,s.TEXTURE_MIN_FILTER,s.NEAREST),s.texParameteri(V,s.TEXTURE_MAG_FILTER,s.NEAREST);for(let qt=0;qt<at;qt++)V===s.TEXTURE_3D||V===s.TEXTURE_2D_ARRAY?s.texImage3D(ut,0,s.RGBA,1,1,Tt,0,s.RGBA,s.UNSIGNED_BYTE,xt):s.texImage2D(ut+qt,0,s.RGBA,1,1,0,s.RGBA,s.UNSIGNED_BYTE,xt);return Mt}let lt={};lt[s.TEXTURE_2D]=nt(s.TEXTURE_2D,s.TEXTURE_2D,1),lt[s.TEXTURE_CUBE_MAP]=nt(s.TEXTURE_CUBE_MAP,s.TEXTURE_CUBE_MAP_POSITIVE_X,6),lt[s.TEXTURE_2D_ARRAY]=nt(s.TEXTURE_2D_ARRAY,s.TEXTURE_2D_ARRAY,1,1),lt[s.TEXTURE_3D]=nt(s.TEXTURE_3D,s.TEXTURE_3D,1,1),r.setClear(0,0,0,1),o.setClear(1),a.setClear(0),gt(s.DEPTH_TEST),o.setFunc(ha),pn(!1),Ue(Yp),gt(s.CULL_FACE),Ze(go);function gt(V){h[V]!==!0&&(s.enable(V),h[V]=!0)}function Ut(V){h[V]!==!1&&(s.disable(V),h[V]=!1)}function Kt(V,ut){return d[V]!==ut?(s.bindFramebuffer(V,ut),d[V]=ut,V===s.DRAW_FRAMEBUFFER&&(d[s.FRAMEBUFFER]=ut),V===s.FRAMEBUFFER&&(d[s.DRAW_FRAMEBUFFER]=ut),!0):!1}function zt(V,ut){let at=m,Tt=!1;if(V){at=f.get(ut),at===void 0&&(at=[],f.set(ut,at));let xt=V.textures;if(at.length!==xt.length||at[0]!==s.COLOR_ATTACHMENT0){for(let Mt=0,qt=xt.length;Mt<qt;Mt++)at[Mt]=s.COLOR_ATTACHMENT0+Mt;at.length=xt.length,Tt=!0}}else at[0]!==s.BACK&&(at[0]=s.BACK,Tt=!0);Tt&&s.drawBuffers(at)}function ge(V){return y!==V?(s.useProgram(V),y=V,!0):!1}let fe={[yo]:s.FUNC_ADD,[q_]:s.FUNC_SUBTRACT,[j_]:s.FUNC_REVERSE_SUBTRACT};fe[Y_]=s.MIN,fe[$_]=s.MAX;let re={[J_]:s.ZERO,[K_]:s.ONE,[Z_]:s.SRC_COLOR,[Qp]:s.SRC_ALPHA,[sx]:s.SRC_ALPHA_SATURATE,[nx]:s.DST_COLOR,[tx]:s.DST_ALPHA,[Q_]:s.ONE_MINUS_SRC_COLOR,[tm]:s.ONE_MINUS_SRC_ALPHA,[ix]:s.ONE_MINUS_DST_COLOR,[ex]:s.ONE_MINUS_DST_ALPHA,[rx]:s.CONSTANT_COLOR,[ox]:s.ONE_MINUS_CONSTANT_COLOR,[ax]:s.CONSTANT_ALPHA,[lx]:s.ONE_MINUS_CONSTANT_ALPHA};function Ze(V,ut,at,Tt,xt,Mt,qt,ee,pt,Vt){if(V===go){p===!0&&(Ut(s.BLEND),p=!1);return}if(p===!1&&(gt(s.BLEND),p=!0),V!==X_){if(V!==g||Vt!==P){if((_!==yo||A!==yo)&&(s.blendEquation(s.FUNC_ADD),_=yo,A=yo),Vt)switch(V){case Ea:s.blendFuncSeparate(s.ONE,s.ONE_MINUS_SRC_ALPHA,s.ONE,s.ONE_MINUS_SRC_ALPHA);break;case Jp:s.blendFunc(s.ONE,s.ONE);break;case Kp:s.blendFuncSeparate(s.ZERO,s.ONE_MINUS_SRC_COLOR,s.ZERO,s.ONE);break;case Zp:s.blendFuncSeparate(s.DST_COLOR,s.ONE_MINUS_SRC_ALPHA,s.ZERO,s.ONE);break;default:te("WebGLState: Invalid blending: ",V);break}else switch(V){case Ea:s.blendFuncSeparate(s.SRC_ALPHA,s.ONE_MINUS_SRC_ALPHA,s.ONE,s.ONE_MINUS_SRC_ALPHA);break;case Jp:s.blendFuncSeparate(s.SRC_ALPHA,s.ONE,s.ONE,s.ONE);break;case Kp:te("WebGLState: SubtractiveBlending requires material.premultipliedAlpha = true");break;case Zp:te("WebGLState: MultiplyBlending requires material.premultipliedAlpha = true");break;default:te("WebGLState: Invalid blending: ",V);break}w=null,v=null,S=null,x=null,M.set(0,0,0),L=0,g=V,P=Vt}return}xt=xt||ut,Mt=Mt||at,qt=qt||Tt,(ut!==_||xt!==A)&&(s.blendEquationSeparate(fe[ut],fe[xt]),_=ut,A=xt),(at!==w||Tt!==v||Mt!==S||qt!==x)&&(s.blendFuncSeparate(re[at],re[Tt],re[Mt],re[qt]),w=at,v=Tt,S=Mt,x=qt),(ee.equals(M)===!1||pt!==L)&&(s.blendColor(ee.r,ee.g,ee.b,pt),M.copy(ee),L=pt),g=V,P=!1}function He(V,ut){V.side===yi?Ut(s.CULL_FACE):gt(s.CULL_FACE);let at=V.side===jn;ut&&(at=!at),pn(at),V.blending===Ea&&V.transparent===!1?Ze(go):Ze(V.blending,V.blendEquation,V.blendSrc,V.blendDst,V.blendEquationAlpha,V.blendSrcAlpha,V.blendDstAlpha,V.blendColor,V.blendAlpha,V.premultipliedAlpha),o.setFunc(V.depthFunc),o.setTest(V.depthTest),o.setMask(V.depthWrite),r.setMask(V.colorWrite);let Tt=V.stencilWrite;a.setTest(Tt),Tt&&(a.setMask(V.stencilWriteMask),a.setFunc(V.stencilFunc,V.stencilRef,V.stencilFuncMask),a.setOp(V.stencilFail,V.stencilZFail,V.stencilZPass)),Me(V.polygonOffset,V.polygonOffsetFactor,V.polygonOffsetUnits),V.alphaToCoverage===!0?gt(s.SAMPLE_ALPHA_TO_COVERAGE):Ut(s.SAMPLE_ALPHA_TO_COVERAGE)}function pn(V){R!==V&&(V?s.frontFace(s.CW):s.frontFace(s.CCW),R=V)}function Ue(V){V!==G_?(gt(s.CULL_FACE),V!==O&&(V===Yp?s.cullFace(s.BACK):V===H_?s.cullFace(s.FRONT):s.cullFace(s.FRONT_AND_BACK))):Ut(s.CULL_FACE),O=V}function Ln(V){V!==k&&(H&&s.lineWidth(V),k=V)}function Me(V,ut,at){V?(gt(s.POLYGON_OFFSET_FILL),(N!==ut||W!==at)&&(N=ut,W=at,o.getReversed()&&(ut=-ut,at=-at),s.polygonOffset(ut,at))):Ut(s.POLYGON_OFFSET_FILL)}function Mn(V){V?gt(s.SCISSOR_TEST):Ut(s.SCISSOR_TEST)}function rn(V){V===void 0&&(V=s.TEXTURE0+z-1),K!==V&&(s.activeTexture(V),K=V)}function mn(V,ut,at){at===void 0&&(K===null?at=s.TEXTURE0+z-1:at=K);let Tt=tt[at];Tt===void 0&&(Tt={type:void 0,texture:void 0},tt[at]=Tt),(Tt.type!==V||Tt.texture!==ut)&&(K!==at&&(s.activeTexture(at),K=at),s.bindTexture(V,ut||lt[V]),Tt.type=V,Tt.texture=ut)}function G(){let V=tt[K];V!==void 0&&V.type!==void 0&&(s.bindTexture(V.type,null),V.type=void 0,V.texture=void 0)}function Pt(){try{s.compressedTexImage2D(...arguments)}catch(V){te("WebGLState:",V)}}function Zt(){try{s.compressedTexImage3D(...arguments)}catch(V){te("WebGLState:",V)}}function ae(){try{s.texSubImage2D(...arguments)}catch(V){te("WebGLState:",V)}}function wt(){try{s.texSubImage3D(...arguments)}catch(V){te("WebGLState:",V)}}function ke(){try{s.compressedTexSubImage2D(...arguments)}catch(V){te("WebGLState:",V)}}function Wt(){try{s.compressedTexSubImage3D(...arguments)}catch(V){te("WebGLState:",V)}}function Jt(){try{s.texStorage2D(...arguments)}catch(V){te("WebGLState:",V)}}function I(){try{s.texStorage3D(...arguments)}catch(V){te("WebGLState:",V)}}function T(){try{s.texImage2D(...arguments)}catch(V){te("WebGLState:",V)}}function $(){try{s.texImage3D(...arguments)}catch(V){te("WebGLState:",V)}}function mt(V){return u[V]!==void 0?u[V]:s.getParameter(V)}function dt(V,ut){u[V]!==ut&&(s.pixelStorei(V,ut),u[V]=ut)}function vt(V){j.equals(V)===!1&&(s.scissor(V.x,V.y,V.z,V.w),j.copy(V))}function bt(V){rt.equals(V)===!1&&(s.viewport(V.x,V.y,V.z,V.w),rt.copy(V))}function ot(V,ut){let at=c.get(ut);at===void 0&&(at=new WeakMap,c.set(ut,at));let Tt=at.get(V);Tt===void 0&&(Tt=s.getUniformBlockIndex(ut,V.name),s.uniformBlockBinding(ut,Tt,Tt),at.set(V,Tt))}function ct(V,ut,at){let xt=c.get(ut).get(V);l[xt]!==at&&(s.bindBufferBase(s.UNIFORM_BUFFER,xt,at),l[xt]=at)}function _t(){s.disable(s.BLEND),s.disable(s.CULL_FACE),s.disable(s.DEPTH_TEST),s.disable(s.POLYGON_OFFSET_FILL),s.disable(s.SCISSOR_TEST),s.disable(s.STENCIL_TEST),s.disable(s.SAMPLE_ALPHA_TO_COVERAGE),s.blendEquation(s.FUNC_ADD),s.blendFunc(s.ONE,s.ZERO),s.blendFuncSeparate(s.ONE,s.ZERO,s.ONE,s.ZERO),s.blendColor(0,0,0,0),s.colorMask(!0,!0,!0,!0),s.clearColor(0,0,0,0),s.depthMask(!0),s.depthFunc(s.LESS),o.setReversed(!1),s.clearDepth(1),s.stencilMask(4294967295),s.stencilFunc(s.ALWAYS,0,4294967295),s.stencilOp(s.KEEP,s.KEEP,s.KEEP),s.clearStencil(0),s.cullFace(s.BACK),s.frontFace(s.CCW),s.polygonOffset(0,0),s.activeTexture(s.TEXTURE0),s.bindFramebuffer(s.FRAMEBUFFER,null),s.bindFramebuffer(s.DRAW_FRAMEBUFFER,null),s.bindFramebuffer(s.READ_FRAMEBUFFER,null),s.useProgram(null),s.lineWidth(1),s.scissor(0,0,s.canvas.width,s.canvas.height),s.viewport(0,0,s.canvas.width,s.canvas.height),s.pixelStorei(s.PACK_ALIGNMENT,4),s.pixelStorei(s.UNPACK_ALIGNMENT,4),s.pixelStorei(s.UNPACK_FLIP_Y_WEBGL,!1),s.pixelStorei(s.UNPACK_PREMULTIPLY_ALPHA_WEBGL,!1),s.pixelStorei(s.UNPACK_COLORSPACE_CONVERSION_WEBGL,s.BROWSER_DEFAULT_WEBGL),s.pixelStorei(s.PACK_ROW_LENGTH,0),s.pixelStorei(s.PACK_SKIP_PIXELS,0),s.pixelStorei(s.PACK_SKIP_ROWS,0),s.pixelStorei(s.UNPACK_ROW_LENGTH,0),s.pixelStorei(s.UNPACK_IMAGE_HEIGHT,0),s.pixelStorei(s.UNPACK_SKIP_PIXELS,0),s.pixelStorei(s.UNPACK_SKIP_ROWS,0),s.pixelStorei(s.UNPACK_SKIP_IMAGES,0),h={},u={},K=null,tt={},d={},l={},f=new WeakMap,m=[],y=null,p=!1,g=null,_=null,w=null,v=null,A=null,S=null,x=null,M=new Rt(0,0,0),L=0,P=!1,R=null,O=null,k=null,N=null,W=null,j.set(0,0,s.canvas.width,s.canvas.height),rt.set(0,0,s.canvas.width,s.canvas.height),r.reset(),o.reset(),a.reset()}return{buffers:{color:r,depth:o,stencil:a},enable:gt,disable:Ut,bindFramebuffer:Kt,drawBuffers:zt,useProgram:ge,setBlending:Ze,setMaterial:He,setFlipSided:pn,setCullFace:Ue,setLineWidth:Ln,setPolygonOffset:Me,setScissorTest:Mn,activeTexture:rn,bindTexture:mn,unbindTexture:G,compressedTexImage2D:Pt,compressedTexImage3D:Zt,texImage2D:T,texImage3D:$,pixelStorei:dt,getParameter:mt,updateUBOMapping:ot,uniformBlockBinding:ct,texStorage2D:Jt,texStorage3D:I,texSubImage2D:ae,texSubImage3D:wt,compressedTexSubImage2D:ke,compressedTexSubImage3D:Wt,scissor:vt,viewport:bt,reset:_t}}function jR(s,t,e,n,i,r,o){let a=t.has("WEBGL_multisampled_render_to_texture")?t.get("WEBGL_multisampled_render_to_texture"):null,l=typeof navigator>"u"?!1:/OculusBrowser/g.test(navigator.userAgent),c=new Xt,h=new WeakMap,u=new Set,d,f=new WeakMap,m=new Set,y=new FinalizationRegistry(I=>m.delete(I)),p=!1;try{p=typeof OffscreenCanvas<"u"&&new OffscreenCanvas(1,1).getContext("2d")!==null}catch{}function g(I,T){return p?new OffscreenCanvas(I,T):da("canvas")}function _(I,T,$){let mt=1,dt=Jt(I);if((dt.width>$||dt.height>$)&&(mt=$/Math.max(dt.width,dt.height)),mt<1)if(typeof HTMLImageElement<"u"&&I instanceof HTMLImageElement||typeof HTMLCanvasElement<"u"&&I instanceof HTMLCanvasElement||typeof ImageBitmap<"u"&&I instanceof ImageBitmap||typeof VideoFrame<"u"&&I instanceof VideoFrame){let vt=Math.floor(mt*dt.width),bt=Math.floor(mt*dt.height);d===void 0&&(d=g(vt,bt));let ot=T?g(vt,bt):d;return ot.width=vt,ot.height=bt,ot.getContext("2d").drawImage(I,0,0,vt,bt),Yt("WebGLRenderer: Texture has been resized from ("+dt.width+"x"+dt.height+") to ("+vt+"x"+bt+")."),ot}else return"data"in I&&Yt("WebGLRenderer: Image in DataTexture is too big ("+dt.width+"x"+dt.height+")."),I;return I}function w(I){return I.generateMipmaps}function v(I){s.generateMipmap(I)}function A(I){return I.isWebGLCubeRenderTarget?s.TEXTURE_CUBE_MAP:I.isWebGL3DRenderTarget?s.TEXTURE_3D:I.isWebGLArrayRenderTarget||I.isCompressedArrayTexture?s.TEXTURE_2D_ARRAY:s.TEXTURE_2D}function S(I,T,$,mt,dt,vt=!1){if(I!==null){if(s[I]!==void 0)return s[I];Yt("WebGLRenderer: Attempt to use non-existing WebGL internal format '"+I+"'")}let bt;mt&&(bt=t.get("EXT_texture_norm16"),bt||Yt("WebGLRenderer: Unable to use normalized textures without EXT_texture_norm16 extension"));let ot=T;if(T===s.RED&&($===s.FLOAT&&(ot=s.R32F),$===s.HALF_FLOAT&&(ot=s.R16F),$===s.UNSIGNED_BYTE&&(ot=s.R8),$===s.UNSIGNED_SHORT&&bt&&(ot=bt.R16_EXT),$===s.SHORT&&bt&&(ot=bt.R16_SNORM_EXT)),T===s.RED_INTEGER&&($===s.UNSIGNED_BYTE&&(ot=s.R8UI),$===s.UNSIGNED_SHORT&&(ot=s.R16UI),$===s.UNSIGNED_INT&&(ot=s.R32UI),$===s.BYTE&&(ot=s.R8I),$===s.SHORT&&(ot=s.R16I),$===s.INT&&(ot=s.R32I)),T===s.RG&&($===s.FLOAT&&(ot=s.RG32F),$===s.HALF_FLOAT&&(ot=s.RG16F),$===s.UNSIGNED_BYTE&&(ot=s.RG8),$===s.UNSIGNED_SHORT&&bt&&(ot=bt.RG16_EXT),$===s.SHORT&&bt&&(ot=bt.RG16_SNORM_EXT)),T===s.RG_INTEGER&&($===s.UNSIGNED_BYTE&&(ot=s.RG8UI),$===s.UNSIGNED_SHORT&&(ot=s.RG16UI),$===s.UNSIGNED_INT&&(ot=s.RG32UI),$===s.BYTE&&(ot=s.RG8I),$===s.SHORT&&(ot=s.RG16I),$===s.INT&&(ot=s.RG32I)),T===s.RGB_INTEGER&&($===s.UNSIGNED_BYTE&&(ot=s.RGB8UI),$===s.UNSIGNED_SHORT&&(ot=s.RGB16UI),$===s.UNSIGNED_INT&&(ot=s.RGB32UI),$===s.BYTE&&(ot=s.RGB8I),$===s.SHORT&&(ot=s.RGB16I),$===s.INT&&(ot=s.RGB32I)),T===s.RGBA_INTEGER&&($===s.UNSIGNED_BYTE&&(ot=s.RGBA8UI),$===s.UNSIGNED_SHORT&&(ot=s.RGBA16UI),$===s.UNSIGNED_INT&&(ot=s.RGBA32UI),$===s.BYTE&&(ot=s.RGBA8I),$===s.SHORT&&(ot=s.RGBA16I),$===s.INT&&(ot=s.RGBA32I)),T===s.RGB&&($===s.UNSIGNED_SHORT&&bt&&(ot=bt.RGB16_EXT),$===s.SHORT&&bt&&(ot=bt.RGB16_SNORM_EXT),$===s.UNSIGNED_INT_5_9_9_9_REV&&(ot=s.RGB9_E5),$===s.UNSIGNED_INT_10F_11F_11F_REV&&(ot=s.R11F_G11F_B10F)),T===s.RGBA){let ct=vt?xl:ue.getTransfer(dt);$===s.FLOAT&&(ot=s.RGBA32F),$===s.HALF_FLOAT&&(ot=s.RGBA16F),$===s.UNSIGNED_BYTE&&(ot=ct===Ne?s.SRGB8_ALPHA8:s.RGBA8),$===s.UNSIGNED_SHORT&&bt&&(ot=bt.RGBA16_EXT),$===s.SHORT&&bt&&(ot=bt.RGBA16_SNORM_EXT),$===s.UNSIGNED_SHORT_4_4_4_4&&(ot=s.RGBA4),$===s.UNSIGNED_SHORT_5_5_5_1&&(ot=s.RGB5_A1)}return(ot===s.R16F||ot===s.R32F||ot===s.RG16F||ot===s.RG32F||ot===s.RGBA16F||ot===s.RGBA32F)&&t.get("EXT_color_buffer_float"),ot}function x(I,T){let $;return I?T===null||T===us||T===xo?$=s.DEPTH24_STENCIL8:T===ki?$=s.DEPTH32F_STENCIL8:T===Ra&&($=s.DEPTH24_STENCIL8,Yt("DepthTexture: 16 bit depth attachment is not supported with stencil. Using 24-bit attachment.")):T===null||T===us||T===xo?$=s.DEPTH_COMPONENT24:T===ki?$=s.DEPTH_COMPONENT32F:T===Ra&&($=s.DEPTH_COMPONENT16),$}function M(I,T){return w(I)===!0||I.isFramebufferTexture&&I.minFilter!==kn&&I.minFilter!==Bn?Math.log2(Math.max(T.width,T.height))+1:I.mipmaps.length>0?I.mipmaps.length:I.isCompressedTexture&&Array.isArray(I.image)?T.mipmaps.length:1}function L(I){let T=new WeakRef(I);n.get(I).__ref=T,m.add(T),y.register(I,T,T)}function P(I){let T=n.get(I).__ref;T!==void 0&&(m.delete(T),y.unregister(T))}function R(I){k(I.target)}function O(I){N(I.target)}function k(I){I.removeEventListener("dispose",R),P(I),z(I),I.isVideoTexture&&h.delete(I),I.isHTMLTexture&&u.delete(I)}function N(I){I.removeEventListener("dispose",O),P(I),it(I)}function W(){for(let I of m){let T=I.deref();T!==void 0&&(T.isRenderTarget===!0?N(T):k(T))}m.clear(),u.clear()}function z(I){let T=n.get(I);if(T.__webglInit===void 0)return;let $=I.source,mt=f.get($);if(mt){let dt=mt[T.__cacheKey];dt.usedTimes--,dt.usedTimes===0&&H(I),Object.keys(mt).length===0&&f.delete($)}n.remove(I)}function H(I){let T=n.get(I);s.deleteTexture(T.__webglTexture);let $=I.source,mt=f.get($);delete mt[T.__cacheKey],o.memory.textures--}function it(I){let T=n.get(I);T.__depthDisposeCallback&&T.__depthDisposeCallback();let $=I.depthTexture;if($&&$.renderTarget===I&&k($),I.isWebGLCubeRenderTarget)for(let dt=0;dt<6;dt++){if(Array.isArray(T.__webglFramebuffer[dt]))for(let vt=0;vt<T.__webglFramebuffer[dt].length;vt++)s.deleteFramebuffer(T.__webglFramebuffer[dt][vt]);else s.deleteFramebuffer(T.__webglFramebuffer[dt]);T.__webglDepthbuffer&&s.deleteRenderbuffer(T.__webglDepthbuffer[dt])}else{if(Array.isArray(T.__webglFramebuffer))for(let dt=0;dt<T.__webglFramebuffer.length;dt++)s.deleteFramebuffer(T.__webglFramebuffer[dt]);else s.deleteFramebuffer(T.__webglFramebuffer);if(T.__webglDepthbuffer&&s.deleteRenderbuffer(T.__webglDepthbuffer),T.__webglMultisampledFramebuffer&&s.deleteFramebuffer(T.__webglMultisampledFramebuffer),T.__webglColorRenderbuffer)for(let dt=0;dt<T.__webglColorRenderbuffer.length;dt++)T.__webglColorRenderbuffer[dt]&&s.deleteRenderbuffer(T.__webglColorRenderbuffer[dt]);T.__webglDepthRenderbuffer&&s.deleteRenderbuffer(T.__webglDepthRenderbuffer)}let mt=I.textures;for(let dt=0,vt=mt.length;dt<vt;dt++){let bt=n.get(mt[dt]);bt.__webglTexture&&(s.deleteTexture(bt.__webglTexture),o.memory.textures--),n.remove(mt[dt])}n.remove(I)}let Y=0;function K(){Y=0}function tt(){return Y}function ht(I){Y=I}function st(){let I=Y;return I>=i.maxTextures&&Yt("WebGLTextures: Trying to use "+(I+1)+" texture units while this GPU supports only "+i.maxTextures),Y+=1,I}function j(I){let T=[];return T.push(I.wrapS),T.push(I.wrapT),T.push(I.wrapR||0),T.push(I.magFilter),T.push(I.minFilter),T.push(I.anisotropy),T.push(I.internalFormat),T.push(I.format),T.push(I.type),T.push(I.generateMipmaps),T.push(I.mipmapsAutoUpdate),T.push(I.premultiplyAlpha),T.push(I.flipY),T.push(I.unpackAlignment),T.push(I.colorSpace),T.join()}function rt(I,T){let $=n.get(I);if(I.isVideoTexture&&ke(I),I.isRenderTargetTexture===!1&&I.isExternalTexture!==!0&&I.version>0&&$.__version!==I.version){let mt=I.image;if(mt===null)Yt("WebGLRenderer: Texture marked for update but no image data found.");else if(mt.complete===!1)Yt("WebGLRenderer: Texture marked for update but image is incomplete");else{He($,I,T);return}}else I.isExternalTexture&&($.__webglTexture=I.sourceTexture?I.sourceTexture:null);e.bindTexture(s.TEXTURE_2D,$.__webglTexture,s.TEXTURE0+T)}function nt(I,T){let $=n.get(I);if(I.isRenderTargetTexture===!1&&I.version>0&&$.__version!==I.version){He($,I,T);return}else I.isExternalTexture&&($.__webglTexture=I.sourceTexture?I.sourceTexture:null);e.bindTexture(s.TEXTURE_2D_ARRAY,$.__webglTexture,s.TEXTURE0+T)}function lt(I,T){let $=n.get(I);if(I.isRenderTargetTexture===!1&&I.version>0&&$.__version!==I.version){He($,I,T);return}e.bindTexture(s.TEXTURE_3D,$.__webglTexture,s.TEXTURE0+T)}function gt(I,T){let $=n.get(I);if(I.version>0&&$.__version!==I.version){pn($,I,T);return}e.bindTexture(s.TEXTURE_CUBE_MAP,$.__webglTexture,s.TEXTURE0+T)}let Ut={[Js]:s.REPEAT,[pi]:s.CLAMP_TO_EDGE,[Kh]:s.MIRRORED_REPEAT},Kt={[kn]:s.NEAREST,[dx]:s.NEAREST_MIPMAP_NEAREST,[Jl]:s.NEAREST_MIPMAP_LINEAR,[Bn]:s.LINEAR,[_u]:s.LINEAR_MIPMAP_NEAREST,[$i]:s.LINEAR_MIPMAP_LINEAR},zt={[yx]:s.NEVER,[ym]:s.ALWAYS,[_x]:s.LESS,[mm]:s.LEQUAL,[xx]:s.EQUAL,[gm]:s.GEQUAL,[vx]:s.GREATER,[bx]:s.NOTEQUAL};function ge(I,T){if(T.type===ki&&t.has("OES_texture_float_linear")===!1&&(T.magFilter===Bn||T.magFilter===_u||T.magFilter===Jl||T.magFilter===$i||T.minFilter===Bn||T.minFilter===_u||T.minFilter===Jl||T.minFilter===$i)&&Yt("WebGLRenderer: Unable to use linear filtering with floating point textures. OES_texture_float_linear not supported on this device."),s.texParameteri(I,s.TEXTURE_WRAP_S,Ut[T.wrapS]),s.texParameteri(I,s.TEXTURE_WRAP_T,Ut[T.wrapT]),(I===s.TEXTURE_3D||I===s.TEXTURE_2D_ARRAY)&&s.texParameteri(I,s.TEXTURE_WRAP_R,Ut[T.wrapR]),s.texParameteri(I,s.TEXTURE_MAG_FILTER,Kt[T.magFilter]),s.texParameteri(I,s.TEXTURE_MIN_FILTER,Kt[T.minFilter]),T.compareFunction&&(s.texParameteri(I,s.TEXTURE_COMPARE_MODE,s.COMPARE_REF_TO_TEXTURE),s.texParameteri(I,s.TEXTURE_COMPARE_FUNC,zt[T.compareFunction])),t.has("EXT_texture_filter_anisotropic")===!0){if(T.magFilter===kn||T.minFilter!==Jl&&T.minFilter!==$i||T.type===ki&&t.has("OES_texture_float_linear")===!1)return;if(T.anisotropy>1||n.get(T).__currentAnisotropy){let $=t.get("EXT_texture_filter_anisotropic");s.texParameterf(I,$.TEXTURE_MAX_ANISOTROPY_EXT,Math.min(T.anisotropy,i.getMaxAnisotropy())),n.get(T).__currentAnisotropy=T.anisotropy}}}function fe(I,T){let $=!1;I.__webglInit===void 0&&(I.__webglInit=!0,T.addEventListener("dispose",R),L(T));let mt=T.source,dt=f.get(mt);dt===void 0&&(dt={},f.set(mt,dt));let vt=j(T);if(vt!==I.__cacheKey){dt[vt]===void 0&&(dt[vt]={texture:s.createTexture(),usedTimes:0},o.memory.textures++,$=!0),dt[vt].usedTimes++;let bt=dt[I.__cacheKey];bt!==void 0&&(dt[I.__cacheKey].usedTimes--,bt.usedTimes===0&&H(T)),I.__cacheKey=vt,I.__webglTexture=dt[vt].texture}return $}function re(I,T,$){return Math.floor(Math.floor(I/$)/T)}function Ze(I,T,$,mt){let vt=I.updateRanges;if(vt.length===0)e.texSubImage2D(s.TEXTURE_2D,0,0,0,T.width,T.height,$,mt,T.data);else{vt.sort((V,ut)=>V.start-ut.start);let bt=0;for(let V=1;V<vt.length;V++){let ut=vt[bt],at=vt[V],Tt=ut.start+ut.count,xt=re(at.start,T.width,4),Mt=re(ut.start,T.width,4);at.start<=Tt+1&&xt===Mt&&re(at.start+at.count-1,T.width,4)===xt?ut.count=Math.max(ut.count,at.start+at.count-ut.start):(++bt,vt[bt]=at)}vt.length=bt+1;let ot=e.getParameter(s.UNPACK_ROW_LENGTH),ct=e.getParameter(s.UNPACK_SKIP_PIXELS),_t=e.getParameter(s.UNPACK_SKIP_ROWS);e.pixelStorei(s.UNPACK_ROW_LENGTH,T.width);for(let V=0,ut=vt.length;V<ut;V++){let at=vt[V],Tt=Math.floor(at.start/4),xt=Math.ceil(at.count/4),Mt=Tt%T.width,qt=Math.floor(Tt/T.width),ee=xt,pt=1;e.pixelStorei(s.UNPACK_SKIP_PIXELS,Mt),e.pixelStorei(s.UNPACK_SKIP_ROWS,qt),e.texSubImage2D(s.TEXTURE_2D,0,Mt,qt,ee,pt,$,mt,T.data)}I.clearUpdateRanges(),e.pixelStorei(s.UNPACK_ROW_LENGTH,ot),e.pixelStorei(s.UNPACK_SKIP_PIXELS,ct),e.pixelStorei(s.UNPACK_SKIP_ROWS,_t)}}function He(I,T,$){let mt=s.TEXTURE_2D;(T.isDataArrayTexture||T.isCompressedArrayTexture)&&(mt=s.TEXTURE_2D_ARRAY),T.isData3DTexture&&(mt=s.TEXTURE_3D);let dt=fe(I,T),vt=T.source;e.bindTexture(mt,I.__webglTexture,s.TEXTURE0+$);let bt=n.get(vt);if(vt.version!==bt.__version||dt===!0){if(e.activeTexture(s.TEXTURE0+$),(typeof ImageBitmap<"u"&&T.image instanceof ImageBitmap)===!1){let pt=ue.getPrimaries(ue.workingColorSpace),Vt=T.colorSpace===rr?null:ue.getPrimaries(T.colorSpace),ne=T.colorSpace===rr||pt===Vt?s.NONE:s.BROWSER_DEFAULT_WEBGL;e.pixelStorei(s.UNPACK_FLIP_Y_WEBGL,T.flipY),e.pixelStorei(s.UNPACK_PREMULTIPLY_ALPHA_WEBGL,T.premultiplyAlpha),e.pixelStorei(s.UNPACK_COLORSPACE_CONVERSION_WEBGL,ne)}e.pixelStorei(s.UNPACK_ALIGNMENT,T.unpackAlignment);let ct=_(T.image,!1,i.maxTextureSize);ct=Wt(T,ct);let _t=r.convert(T.format,T.colorSpace),V=r.convert(T.type),ut=S(T.internalFormat,_t,V,T.normalized,T.colorSpace,T.isVideoTexture);ge(mt,T);let at,Tt=T.mipmaps,xt=T.isVideoTexture!==!0,Mt=bt.__version===void 0||dt===!0,qt=vt.dataReady,ee=M(T,ct);if(T.isDepthTexture)ut=x(T.format===sr,T.type),Mt&&(xt?e.texStorage2D(s.TEXTURE_2D,1,ut,ct.width,ct.height):e.texImage2D(s.TEXTURE_2D,0,ut,ct.width,ct.height,0,_t,V,null));else if(T.isDataTexture)if(Tt.length>0){xt&&Mt&&e.texStorage2D(s.TEXTURE_2D,ee,ut,Tt[0].width,Tt[0].height);for(let pt=0,Vt=Tt.length;pt<Vt;pt++)at=Tt[pt],xt?qt&&e.texSubImage2D(s.TEXTURE_2D,pt,0,0,at.width,at.height,_t,V,at.data):e.texImage2D(s.TEXTURE_2D,pt,ut,at.width,at.height,0,_t,V,at.data);T.generateMipmaps=!1}else xt?(Mt&&e.texStorage2D(s.TEXTURE_2D,ee,ut,ct.width,ct.height),qt&&Ze(T,ct,_t,V)):e.texImage2D(s.TEXTURE_2D,0,ut,ct.width,ct.height,0,_t,V,ct.data);else if(T.isCompressedTexture)if(T.isCompressedArrayTexture){xt&&Mt&&e.texStorage3D(s.TEXTURE_2D_ARRAY,ee,ut,Tt[0].width,Tt[0].height,ct.depth);for(let pt=0,Vt=Tt.length;pt<Vt;pt++)if(at=Tt[pt],T.format!==Ji)if(_t!==null)if(xt){if(qt)if(T.layerUpdates.size>0){let ne=Em(at.width,at.height,T.format,T.type);for(let Ct of T.layerUpdates){let ce=at.data.subarray(Ct*ne/at.data.BYTES_PER_ELEMENT,(Ct+1)*ne/at.data.BYTES_PER_ELEMENT);e.compressedTexSubImage3D(s.TEXTURE_2D_ARRAY,pt,0,0,Ct,at.width,at.height,1,_t,ce)}}else e.compressedTexSubImage3D(s.TEXTURE_2D_ARRAY,pt,0,0,0,at.width,at.height,ct.depth,_t,at.data)}else e.compressedTexImage3D(s.TEXTURE_2D_ARRAY,pt,ut,at.width,at.height,ct.depth,0,at.data,0,0);else Yt("WebGLRenderer: Attempt to load unsupported compressed texture format in .uploadTexture()");else xt?qt&&e.texSubImage3D(s.TEXTURE_2D_ARRAY,pt,0,0,0,at.width,at.height,ct.depth,_t,V,at.data):e.texImage3D(s.TEXTURE_2D_ARRAY,pt,ut,at.width,at.height,ct.depth,0,_t,V,at.data);T.layerUpdates.size>0&&T.clearLayerUpdates()}else{xt&&Mt&&e.texStorage2D(s.TEXTURE_2D,ee,ut,Tt[0].width,Tt[0].height);for(let pt=0,Vt=Tt.length;pt<Vt;pt++)at=Tt[pt],T.format!==Ji?_t!==null?xt?qt&&e.compressedTexSubImage2D(s.TEXTURE_2D,pt,0,0,at.width,at.height,_t,at.data):e.compressedTexImage2D(s.TEXTURE_2D,pt,ut,at.width,at.height,0,at.data):Yt("WebGLRenderer: Attempt to load unsupported compressed texture format in .uploadTexture()"):xt?qt&&e.texSubImage2D(s.TEXTURE_2D,pt,0,0,at.width,at.height,_t,V,at.data):e.texImage2D(s.TEXTURE_2D,pt,ut,at.width,at.height,0,_t,V,at.data)}else if(T.isDataArrayTexture)if(xt){if(Mt&&e.texStorage3D(s.TEXTURE_2D_ARRAY,ee,ut,ct.width,ct.height,ct.depth),qt)if(T.layerUpdates.size>0){let pt=Em(ct.width,ct.height,T.format,T.type);for(let Vt of T.layerUpdates){let ne=ct.data.subarray(Vt*pt/ct.data.BYTES_PER_ELEMENT,(Vt+1)*pt/ct.data.BYTES_PER_ELEMENT);e.texSubImage3D(s.TEXTURE_2D_ARRAY,0,0,0,Vt,ct.width,ct.height,1,_t,V,ne)}T.clearLayerUpdates()}else e.texSubImage3D(s.TEXTURE_2D_ARRAY,0,0,0,0,ct.width,ct.height,ct.depth,_t,V,ct.data)}else e.texImage3D(s.TEXTURE_2D_ARRAY,0,ut,ct.width,ct.height,ct.depth,0,_t,V,ct.data);else if(T.isData3DTexture)xt?(Mt&&e.texStorage3D(s.TEXTURE_3D,ee,ut,ct.width,ct.height,ct.depth),qt&&e.texSubImage3D(s.TEXTURE_3D,0,0,0,0,ct.width,ct.height,ct.depth,_t,V,ct.data)):e.texImage3D(s.TEXTURE_3D,0,ut,ct.width,ct.height,ct.depth,0,_t,V,ct.data);else if(T.isFramebufferTexture){if(Mt)if(xt)e.texStorage2D(s.TEXTURE_2D,ee,ut,ct.width,ct.height);else{let pt=ct.width,Vt=ct.height;for(let ne=0;ne<ee;ne++)e.texImage2D(s.TEXTURE_2D,ne,ut,pt,Vt,0,_t,V,null),pt>>=1,Vt>>=1}}else if(T.isHTMLTexture){if("texElementImage2D"in s){let pt=s.canvas;if(pt.hasAttribute("layoutsubtree")||pt.setAttribute("layoutsubtree","true"),ct.parentNode!==pt){pt.appendChild(ct),u.add(T),pt.onpaint=Vt=>{let ne=Vt.changedElements;for(let Ct of u)ne.includes(Ct.image)&&(Ct.needsUpdate=!0)},pt.requestPaint();return}if(s.texElementImage2D.length===3)s.texElementImage2D(s.TEXTURE_2D,s.RGBA8,ct);else{let ne=s.RGBA,Ct=s.RGBA,ce=s.UNSIGNED_BYTE;s.texElementImage2D(s.TEXTURE_2D,0,ne,Ct,ce,ct)}s.texParameteri(s.TEXTURE_2D,s.TEXTURE_MIN_FILTER,s.LINEAR),s.texParameteri(s.TEXTURE_2D,s.TEXTURE_WRAP_S,s.CLAMP_TO_EDGE),s.texParameteri(s.TEXTURE_2D,s.TEXTURE_WRAP_T,s.CLAMP_TO_EDGE)}}else if(Tt.length>0){if(xt&&Mt){let pt=Jt(Tt[0]);e.texStorage2D(s.TEXTURE_2D,ee,ut,pt.width,pt.height)}for(let pt=0,Vt=Tt.length;pt<Vt;pt++)at=Tt[pt],xt?qt&&e.texSubImage2D(s.TEXTURE_2D,pt,0,0,_t,V,at):e.texImage2D(s.TEXTURE_2D,pt,ut,_t,V,at);T.generateMipmaps=!1}else if(xt){if(Mt){let pt=Jt(ct);e.texStorage2D(s.TEXTURE_2D,ee,ut,pt.width,pt.height)}qt&&e.texSubImage2D(s.TEXTURE_2D,0,0,0,_t,V,ct)}else e.texImage2D(s.TEXTURE_2D,0,ut,_t,V,ct);w(T)&&T.mipmapsAutoUpdate===!0&&v(mt),bt.__version=vt.version,T.onUpdate&&T.onUpdate(T)}I.__version=T.version}function pn(I,T,$){if(T.image.length!==6)return;let mt=fe(I,T),dt=T.source;e.bindTexture(s.TEXTURE_CUBE_MAP,I.__webglTexture,s.TEXTURE0+$);let vt=n.get(dt);if(dt.version!==vt.__version||mt===!0){e.activeTexture(s.TEXTURE0+$);let bt=ue.getPrimaries(ue.workingColorSpace),ot=T.colorSpace===rr?null:ue.getPrimaries(T.colorSpace),ct=T.colorSpace===rr||bt===ot?s.NONE:s.BROWSER_DEFAULT_WEBGL;e.pixelStorei(s.UNPACK_FLIP_Y_WEBGL,T.flipY),e.pixelStorei(s.UNPACK_PREMULTIPLY_ALPHA_WEBGL,T.premultiplyAlpha),e.pixelStorei(s.UNPACK_ALIGNMENT,T.unpackAlignment),e.pixelStorei(s.UNPACK_COLORSPACE_CONVERSION_WEBGL,ct);let _t=T.isCompressedTexture||T.image[0].isCompressedTexture,V=T.image[0]&&T.image[0].isDataTexture,ut=[];for(let Ct=0;Ct<6;Ct++)!_t&&!V?ut[Ct]=_(T.image[Ct],!0,i.maxCubemapSize):ut[Ct]=V?T.image[Ct].image:T.image[Ct],ut[Ct]=Wt(T,ut[Ct]);let at=ut[0],Tt=r.convert(T.format,T.colorSpace),xt=r.convert(T.type),Mt=S(T.internalFormat,Tt,xt,T.normalized,T.colorSpace),qt=T.isVideoTexture!==!0,ee=vt.__version===void 0||mt===!0,pt=dt.dataReady,Vt=M(T,at);ge(s.TEXTURE_CUBE_MAP,T);let ne;if(T.isDepthTexture){if(Mt=x(T.format===sr,T.type),ee)if(qt)e.texStorage2D(s.TEXTURE_CUBE_MAP,1,Mt,at.width,at.height);else for(let Ct=0;Ct<6;Ct++)e.texImage2D(s.TEXTURE_CUBE_MAP_POSITIVE_X+Ct,0,Mt,at.width,at.height,0,Tt,xt,null)}else if(_t){qt&&ee&&e.texStorage2D(s.TEXTURE_CUBE_MAP,Vt,Mt,at.width,at.height);for(let Ct=0;Ct<6;Ct++){ne=ut[Ct].mipmaps;for(let ce=0;ce<ne.length;ce++){let Xe=ne[ce];T.format!==Ji?Tt!==null?qt?pt&&e.compressedTexSubImage2D(s.TEXTURE_CUBE_MAP_POSITIVE_X+Ct,ce,0,0,Xe.width,Xe.height,Tt,Xe.data):e.compressedTexImage2D(s.TEXTURE_CUBE_MAP_POSITIVE_X+Ct,ce,Mt,Xe.width,Xe.height,0,Xe.data):Yt("WebGLRenderer: Attempt to load unsupported compressed texture format in .setTextureCube()"):qt?pt&&e.texSubImage2D(s.TEXTURE_CUBE_MAP_POSITIVE_X+Ct,ce,0,0,Xe.width,Xe.height,Tt,xt,Xe.data):e.texImage2D(s.TEXTURE_CUBE_MAP_POSITIVE_X+Ct,ce,Mt,Xe.width,Xe.height,0,Tt,xt,Xe.data)}}}else{if(ne=T.mipmaps,qt&&ee){ne.length>0&&Vt++;let Ct=Jt(ut[0]);e.texStorage2D(s.TEXTURE_CUBE_MAP,Vt,Mt,Ct.width,Ct.height)}for(let Ct=0;Ct<6;Ct++)if(V){qt?pt&&e.texSubImage2D(s.TEXTURE_CUBE_MAP_POSITIVE_X+Ct,0,0,0,ut[Ct].width,ut[Ct].height,Tt,xt,ut[Ct].data):e.texImage2D(s.TEXTURE_CUBE_MAP_POSITIVE_X+Ct,0,Mt,ut[Ct].width,ut[Ct].height,0,Tt,xt,ut[Ct].data);for(let ce=0;ce<ne.length;ce++){let oi=ne[ce].image[Ct].image;qt?pt&&e.texSubImage2D(s.TEXTURE_CUBE_MAP_POSITIVE_X+Ct,ce+1,0,0,oi.width,oi.height,Tt,xt,oi.data):e.texImage2D(s.TEXTURE_CUBE_MAP_POSITIVE_X+Ct,ce+1,Mt,oi.width,oi.height,0,Tt,xt,oi.data)}}else{qt?pt&&e.texSubImage2D(s.TEXTURE_CUBE_MAP_POSITIVE_X+Ct,0,0,0,Tt,xt,ut[Ct]):e.texImage2D(s.TEXTURE_CUBE_MAP_POSITIVE_X+Ct,0,Mt,Tt,xt,ut[Ct]);for(let ce=0;ce<ne.length;ce++){let Xe=ne[ce];qt?pt&&e.texSubImage2D(s.TEXTURE_CUBE_MAP_POSITIVE_X+Ct,ce+1,0,0,Tt,xt,Xe.image[Ct]):e.texImage2D(s.TEXTURE_CUBE_MAP_POSITIVE_X+Ct,ce+1,Mt,Tt,xt,Xe.image[Ct])}}}w(T)&&T.mipmapsAutoUpdate===!0&&v(s.TEXTURE_CUBE_MAP),vt.__version=dt.version,T.onUpdate&&T.onUpdate(T)}I.__version=T.version}function Ue(I,T,$,mt,dt,vt){let bt=r.convert($.format,$.colorSpace),ot=r.convert($.type),ct=S($.internalFormat,bt,ot,$.normalized,$.colorSpace),_t=n.get(T),V=n.get($);if(V.__renderTarget=T,!_t.__hasExternalTextures){let ut=Math.max(1,T.width>>vt),at=Math.max(1,T.height>>vt);dt===s.TEXTURE_3D||dt===s.TEXTURE_2D_ARRAY?e.texImage3D(dt,vt,ct,ut,at,T.depth,0,bt,ot,null):e.texImage2D(dt,vt,ct,ut,at,0,bt,ot,null)}e.bindFramebuffer(s.FRAMEBUFFER,I),wt(T)?a.framebufferTexture2DMultisampleEXT(s.FRAMEBUFFER,mt,dt,V.__webglTexture,0,ae(T)):(dt===s.TEXTURE_2D||dt>=s.TEXTURE_CUBE_MAP_POSITIVE_X&&dt<=s.TEXTURE_CUBE_MAP_NEGATIVE_Z)&&s.framebufferTexture2D(s.FRAMEBUFFER,mt,dt,V.__webglTexture,vt),e.bindFramebuffer(s.FRAMEBUFFER,null)}function Ln(I,T,$){if(s.bindRenderbuffer(s.RENDERBUFFER,I),T.depthBuffer){let mt=T.depthTexture,dt=mt&&mt.isDepthTexture?mt.type:null,vt=x(T.stencilBuffer,dt),bt=T.stencilBuffer?s.DEPTH_STENCIL_ATTACHMENT:s.DEPTH_ATTACHMENT;wt(T)?a.renderbufferStorageMultisampleEXT(s.RENDERBUFFER,ae(T),vt,T.width,T.height):$?s.renderbufferStorageMultisample(s.RENDERBUFFER,ae(T),vt,T.width,T.height):s.renderbufferStorage(s.RENDERBUFFER,vt,T.width,T.height),s.framebufferRenderbuffer(s.FRAMEBUFFER,bt,s.RENDERBUFFER,I)}else{let mt=T.textures;for(let dt=0;dt<mt.length;dt++){let vt=mt[dt],bt=r.convert(vt.format,vt.colorSpace),ot=r.convert(vt.type),ct=S(vt.internalFormat,bt,ot,vt.normalized,vt.colorSpace);wt(T)?a.renderbufferStorageMultisampleEXT(s.RENDERBUFFER,ae(T),ct,T.width,T.height):$?s.renderbufferStorageMultisample(s.RENDERBUFFER,ae(T),ct,T.width,T.height):s.renderbufferStorage(s.RENDERBUFFER,ct,T.width,T.height)}}s.bindRenderbuffer(s.RENDERBUFFER,null)}function Me(I,T,$){let mt=T.isWebGLCubeRenderTarget===!0;if(e.bindFramebuffer(s.FRAMEBUFFER,I),!(T.depthTexture&&T.depthTexture.isDepthTexture))throw new Error("THREE.WebGLTextures: renderTarget.depthTexture must be an instance of THREE.DepthTexture.");let dt=n.get(T.depthTexture);dt.__renderTarget=T;let vt=mt?T.depthTexture.image[0]:T.depthTexture.image;(!dt.__webglTexture||vt.width!==T.width||vt.height!==T.height)&&(vt.width=T.width,vt.height=T.height,T.depthTexture.needsUpdate=!0),mt?gt(T.depthTexture,0):rt(T.depthTexture,0);let bt=dt.__webglTexture,ot=ae(T),ct=mt?s.TEXTURE_CUBE_MAP_POSITIVE_X+$:s.TEXTURE_2D,_t=T.depthTexture.format===sr?s.DEPTH_STENCIL_ATTACHMENT:s.DEPTH_ATTACHMENT;if(T.depthTexture.format===Ks)wt(T)?a.framebufferTexture2DMultisampleEXT(s.FRAMEBUFFER,_t,ct,bt,0,ot):s.framebufferTexture2D(s.FRAMEBUFFER,_t,ct,bt,0);else if(T.depthTexture.format===sr)wt(T)?a.framebufferTexture2DMultisampleEXT(s.FRAMEBUFFER,_t,ct,bt,0,ot):s.framebufferTexture2D(s.FRAMEBUFFER,_t,ct,bt,0);else throw new Error("THREE.WebGLTextures: Unknown depthTexture format.")}function Mn(I){let T=n.get(I),$=I.isWebGLCubeRenderTarget===!0;if(T.__boundDepthTexture!==I.depthTexture){let mt=I.depthTexture;if(T.__depthDisposeCallback&&T.__depthDisposeCallback(),mt){let dt=()=>{delete T.__boundDepthTexture,delete T.__depthDisposeCallback,mt.removeEventListener("dispose",dt)};mt.addEventListener("dispose",dt),T.__depthDisposeCallback=dt}T.__boundDepthTexture=mt}if(I.depthTexture&&!T.__autoAllocateDepthBuffer)if($)for(let mt=0;mt<6;mt++)Me(T.__webglFramebuffer[mt],I,mt);else I.texture.mipmaps.length>0?Me(T.__webglFramebuffer[0],I,0):Me(T.__webglFramebuffer,I,0);else if($){T.__webglDepthbuffer=[];for(let mt=0;mt<6;mt++)if(e.bindFramebuffer(s.FRAMEBUFFER,T.__webglFramebuffer[mt]),T.__webglDepthbuffer[mt]===void 0)T.__webglDepthbuffer[mt]=s.createRenderbuffer(),Ln(T.__webglDepthbuffer[mt],I,!1);else{let dt=I.stencilBuffer?s.DEPTH_STENCIL_ATTACHMENT:s.DEPTH_ATTACHMENT,vt=T.__webglDepthbuffer[mt];s.bindRenderbuffer(s.RENDERBUFFER,vt),s.framebufferRenderbuffer(s.FRAMEBUFFER,dt,s.RENDERBUFFER,vt)}}else if(I.texture.mipmaps.length>0?e.bindFramebuffer(s.FRAMEBUFFER,T.__webglFramebuffer[0]):e.bindFramebuffer(s.FRAMEBUFFER,T.__webglFramebuffer),T.__webglDepthbuffer===void 0)T.__webglDepthbuffer=s.createRenderbuffer(),Ln(T.__webglDepthbuffer,I,!1);else{let dt=I.stencilBuffer?s.DEPTH_STENCIL_ATTACHMENT:s.DEPTH_ATTACHMENT,vt=T.__webglDepthbuffer;s.bindRenderbuffer(s.RENDERBUFFER,vt),s.framebufferRenderbuffer(s.FRAMEBUFFER,dt,s.RENDERBUFFER,vt)}e.bindFramebuffer(s.FRAMEBUFFER,null)}function rn(I,T,$){let mt=n.get(I);T!==void 0&&Ue(mt.__webglFramebuffer,I,I.texture,s.COLOR_ATTACHMENT0,s.TEXTURE_2D,0),$!==void 0&&Mn(I)}function mn(I){let T=I.texture,$=n.get(I),mt=n.get(T);I.addEventListener("dispose",O),L(I);let dt=I.textures,vt=I.isWebGLCubeRenderTarget===!0,bt=dt.length>1;if(bt||(mt.__webglTexture===void 0&&(mt.__webglTexture=s.createTexture()),mt.__version=T.version,o.memory.textures++),vt){$.__webglFramebuffer=[];for(let ot=0;ot<6;ot++)if(T.mipmaps.length>0){$.__webglFramebuffer[ot]=[];for(let ct=0;ct<T.mipmaps.length;ct++)$.__webglFramebuffer[ot][ct]=s.createFramebuffer()}else $.__webglFramebuffer[ot]=s.createFramebuffer()}else{if(T.mipmaps.length>0){$.__webglFramebuffer=[];for(let ot=0;ot<T.mipmaps.length;ot++)$.__webglFramebuffer[ot]=s.createFramebuffer()}else $.__webglFramebuffer=s.createFramebuffer();if(bt)for(let ot=0,ct=dt.length;ot<ct;ot++){let _t=n.get(dt[ot]);_t.__webglTexture===void 0&&(_t.__webglTexture=s.createTexture(),o.memory.textures++)}if(I.samples>0&&wt(I)===!1){$.__webglMultisampledFramebuffer=s.createFramebuffer(),$.__webglColorRenderbuffer=[],e.bindFramebuffer(s.FRAMEBUFFER,$.__webglMultisampledFramebuffer);for(let ot=0;ot<dt.length;ot++){let ct=dt[ot];$.__webglColorRenderbuffer[ot]=s.createRenderbuffer(),s.bindRenderbuffer(s.RENDERBUFFER,$.__webglColorRenderbuffer[ot]);let _t=r.convert(ct.format,ct.colorSpace),V=r.convert(ct.type),ut=S(ct.internalFormat,_t,V,ct.normalized,ct.colorSpace,I.isXRRenderTarget===!0),at=ae(I);s.renderbufferStorageMultisample(s.RENDERBUFFER,at,ut,I.width,I.height),s.framebufferRenderbuffer(s.FRAMEBUFFER,s.COLOR_ATTACHMENT0+ot,s.RENDERBUFFER,$.__webglColorRenderbuffer[ot])}s.bindRenderbuffer(s.RENDERBUFFER,null),I.depthBuffer&&($.__webglDepthRenderbuffer=s.createRenderbuffer(),Ln($.__webglDepthRenderbuffer,I,!0)),e.bindFramebuffer(s.FRAMEBUFFER,null)}}if(vt){e.bindTexture(s.TEXTURE_CUBE_MAP,mt.__webglTexture),ge(s.TEXTURE_CUBE_MAP,T);for(let ot=0;ot<6;ot++)if(T.mipmaps.length>0)for(let ct=0;ct<T.mipmaps.length;ct++)Ue($.__webglFramebuffer[ot][ct],I,T,s.COLOR_ATTACHMENT0,s.TEXTURE_CUBE_MAP_POSITIVE_X+ot,ct);else Ue($.__webglFramebuffer[ot],I,T,s.COLOR_ATTACHMENT0,s.TEXTURE_CUBE_MAP_POSITIVE_X+ot,0);w(T)?v(s.TEXTURE_CUBE_MAP):T.mipmaps.length>0&&s.texParameteri(s.TEXTURE_CUBE_MAP,s.TEXTURE_MAX_LEVEL,T.mipmaps.length-1),e.unbindTexture()}else if(bt){for(let ot=0,ct=dt.length;ot<ct;ot++){let _t=dt[ot],V=n.get(_t),ut=s.TEXTURE_2D;(I.isWebGL3DRenderTarget||I.isWebGLArrayRenderTarget)&&(ut=I.isWebGL3DRenderTarget?s.TEXTURE_3D:s.TEXTURE_2D_ARRAY),e.bindTexture(ut,V.__webglTexture),ge(ut,_t),Ue($.__webglFramebuffer,I,_t,s.COLOR_ATTACHMENT0+ot,ut,0),w(_t)&&v(ut)}e.unbindTexture()}else{let ot=s.TEXTURE_2D;if((I.isWebGL3DRenderTarget||I.isWebGLArrayRenderTarget)&&(ot=I.isWebGL3DRenderTarget?s.TEXTURE_3D:s.TEXTURE_2D_ARRAY),e.bindTexture(ot,mt.__webglTexture),ge(ot,T),T.mipmaps.length>0)for(let ct=0;ct<T.mipmaps.length;ct++)Ue($.__webglFramebuffer[ct],I,T,s.COLOR_ATTACHMENT0,ot,ct);else Ue($.__webglFramebuffer,I,T,s.COLOR_ATTACHMENT0,ot,0);w(T)?v(ot):T.mipmaps.length>0&&s.texParameteri(ot,s.TEXTURE_MAX_LEVEL,T.mipmaps.length-1),e.unbindTexture()}I.depthBuffer&&Mn(I)}function G(I){let T=I.textures;for(let $=0,mt=T.length;$<mt;$++){let dt=T[$];if(w(dt)&&dt.mipmapsAutoUpdate===!0){let vt=A(I),bt=n.get(dt).__webglTexture;e.bindTexture(vt,bt),v(vt),e.unbindTexture()}}}let Pt=[];function Zt(I){if(I.samples>0){if(wt(I)===!1){let T=I.textures,$=I.width,mt=I.height,dt=s.COLOR_BUFFER_BIT,vt=I.stencilBuffer?s.DEPTH_STENCIL_ATTACHMENT:s.DEPTH_ATTACHMENT,bt=n.get(I),ot=T.length>1;if(ot)for(let _t=0;_t<T.length;_t++)e.bindFramebuffer(s.FRAMEBUFFER,bt.__webglMultisampledFramebuffer),s.framebufferRenderbuffer(s.FRAMEBUFFER,s.COLOR_ATTACHMENT0+_t,s.RENDERBUFFER,null),e.bindFramebuffer(s.FRAMEBUFFER,bt.__webglFramebuffer),s.framebufferTexture2D(s.DRAW_FRAMEBUFFER,s.COLOR_ATTACHMENT0+_t,s.TEXTURE_2D,null,0);e.bindFramebuffer(s.READ_FRAMEBUFFER,bt.__webglMultisampledFramebuffer),I.texture.mipmaps.length>0?e.bindFramebuffer(s.DRAW_FRAMEBUFFER,bt.__webglFramebuffer[0]):e.bindFramebuffer(s.DRAW_FRAMEBUFFER,bt.__webglFramebuffer);for(let _t=0;_t<T.length;_t++){if(I.resolveDepthBuffer&&(I.depthBuffer&&(dt|=s.DEPTH_BUFFER_BIT),I.stencilBuffer&&I.resolveStencilBuffer&&(dt|=s.STENCIL_BUFFER_BIT)),ot){s.framebufferRenderbuffer(s.READ_FRAMEBUFFER,s.COLOR_ATTACHMENT0,s.RENDERBUFFER,bt.__webglColorRenderbuffer[_t]);let V=n.get(T[_t]).__webglTexture;s.framebufferTexture2D(s.DRAW_FRAMEBUFFER,s.COLOR_ATTACHMENT0,s.TEXTURE_2D,V,0)}s.blitFramebuffer(0,0,$,mt,0,0,$,mt,dt,s.NEAREST),l===!0&&(Pt.length=0,Pt.push(s.COLOR_ATTACHMENT0+_t),I.depthBuffer&&I.storeMultisampledDepthBuffer===!1&&Pt.push(vt),s.invalidateFramebuffer(s.READ_FRAMEBUFFER,Pt))}if(e.bindFramebuffer(s.READ_FRAMEBUFFER,null),e.bindFramebuffer(s.DRAW_FRAMEBUFFER,null),ot)for(let _t=0;_t<T.length;_t++){e.bindFramebuffer(s.FRAMEBUFFER,bt.__webglMultisampledFramebuffer),s.framebufferRenderbuffer(s.FRAMEBUFFER,s.COLOR_ATTACHMENT0+_t,s.RENDERBUFFER,bt.__webglColorRenderbuffer[_t]);let V=n.get(T[_t]).__webglTexture;e.bindFramebuffer(s.FRAMEBUFFER,bt.__webglFramebuffer),s.framebufferTexture2D(s.DRAW_FRAMEBUFFER,s.COLOR_ATTACHMENT0+_t,s.TEXTURE_2D,V,0)}e.bindFramebuffer(s.DRAW_FRAMEBUFFER,bt.__webglMultisampledFramebuffer)}else if(I.depthBuffer&&I.storeMultisampledDepthBuffer===!1&&l){let T=I.stencilBuffer?s.DEPTH_STENCIL_ATTACHMENT:s.DEPTH_ATTACHMENT;s.invalidateFramebuffer(s.DRAW_FRAMEBUFFER,[T])}}}function ae(I){return Math.min(i.maxSamples,I.samples)}function wt(I){let T=n.get(I);return I.samples>0&&t.has("WEBGL_multisampled_render_to_texture")===!0&&T.__useRenderToTexture!==!1}function ke(I){let T=o.render.frame;h.get(I)!==T&&(h.set(I,T),I.update())}function Wt(I,T){let $=I.colorSpace,mt=I.format,dt=I.type;return I.isCompressedTexture===!0||I.isVideoTexture===!0||$!==_l&&$!==rr&&(ue.getTransfer($)===Ne?(mt!==Ji||dt!==Si)&&Yt("WebGLTextures: sRGB encoded textures have to use RGBAFormat and UnsignedByteType."):te("WebGLTextures: Unsupported texture color space:",$)),T}function Jt(I){return typeof HTMLImageElement<"u"&&I instanceof HTMLImageElement?(c.width=I.naturalWidth||I.width,c.height=I.naturalHeight||I.height):typeof VideoFrame<"u"&&I instanceof VideoFrame?(c.width=I.displayWidth,c.height=I.displayHeight):(c.width=I.width,c.height=I.height),c}this.allocateTextureUnit=st,this.resetTextureUnits=K,this.getTextureUnits=tt,this.setTextureUnits=ht,this.setTexture2D=rt,this.setTexture2DArray=nt,this.setTexture3D=lt,this.setTextureCube=gt,this.rebindTextures=rn,this.setupRenderTarget=mn,this.updateRenderTargetMipmap=G,this.updateMultisampleRenderTarget=Zt,this.setupDepthRenderbuffer=Mn,this.setupFrameBufferTexture=Ue,this.useMultisampledRTT=wt,this.dispose=W}function YR(s,t){function e(n,i=rr){let r,o=ue.getTransfer(i);if(n===Si)return s.UNSIGNED_BYTE;if(n===vu)return s.UNSIGNED_SHORT_4_4_4_4;if(n===bu)return s.UNSIGNED_SHORT_5_5_5_1;if(n===um)return s.UNSIGNED_INT_5_9_9_9_REV;if(n===dm)return s.UNSIGNED_INT_10F_11F_11F_REV;if(n===cm)return s.BYTE;if(n===hm)return s.SHORT;if(n===Ra)return s.UNSIGNED_SHORT;if(n===xu)return s.INT;if(n===us)return s.UNSIGNED_INT;if(n===ki)return s.FLOAT;if(n===ds)return s.HALF_FLOAT;if(n===fm)return s.ALPHA;if(n===pm)return s.RGB;if(n===Ji)return s.RGBA;if(n===Ks)return s.DEPTH_COMPONENT;if(n===sr)return s.DEPTH_STENCIL;if(n===Su)return s.RED;if(n===Mu)return s.RED_INTEGER;if(n===Ir)return s.RG;if(n===wu)return s.RG_INTEGER;if(n===Tu)return s.RGBA_INTEGER;if(n===Kl||n===Zl||n===Ql||n===tc)if(o===Ne)if(r=t.get("WEBGL_compressed_texture_s3tc_srgb"),r!==null){if(n===Kl)return r.COMPRESSED_SRGB_S3TC_DXT1_EXT;if(n===Zl)return r.COMPRESSED_SRGB_ALPHA_S3TC_DXT1_EXT;if(n===Ql)return r.COMPRESSED_SRGB_ALPHA_S3TC_DXT3_EXT;if(n===tc)return r.COMPRESSED_SRGB_ALPHA_S3TC_DXT5_EXT}else return null;else if(r=t.get("WEBGL_compressed_texture_s3tc"),r!==null){if(n===Kl)return r.COMPRESSED_RGB_S3TC_DXT1_EXT;if(n===Zl)return r.COMPRESSED_RGBA_S3TC_DXT1_EXT;if(n===Ql)return r.COMPRESSED_RGBA_S3TC_DXT3_EXT;if(n===tc)return r.COMPRESSED_RGBA_S3TC_DXT5_EXT}else return null;if(n===Au||n===Eu||n===Cu||n===Ru)if(r=t.get("WEBGL_compressed_texture_pvrtc"),r!==null){if(n===Au)return r.COMPRESSED_RGB_PVRTC_4BPPV1_IMG;if(n===Eu)return r.COMPRESSED_RGB_PVRTC_2BPPV1_IMG;if(n===Cu)return r.COMPRESSED_RGBA_PVRTC_4BPPV1_IMG;if(n===Ru)return r.COMPRESSED_RGBA_PVRTC_2BPPV1_IMG}else return null;if(n===Pu||n===Lu||n===Iu||n===Nu||n===Du||n===ec||n===Ou)if(r=t.get("WEBGL_compressed_texture_etc"),r!==null){if(n===Pu||n===Lu)return o===Ne?r.COMPRESSED_SRGB8_ETC2:r.COMPRESSED_RGB8_ETC2;if(n===Iu)return o===Ne?r.COMPRESSED_SRGB8_ALPHA8_ETC2_EAC:r.COMPRESSED_RGBA8_ETC2_EAC;if(n===Nu)return r.COMPRESSED_R11_EAC;if(n===Du)return r.COMPRESSED_SIGNED_R11_EAC;if(n===ec)return r.COMPRESSED_RG11_EAC;if(n===Ou)return r.COMPRESSED_SIGNED_RG11_EAC}else return null;if(n===Fu||n===Uu||n===Bu||n===ku||n===zu||n===Vu||n===Gu||n===Hu||n===Wu||n===Xu||n===qu||n===ju||n===Yu||n===$u)if(r=t.get("WEBGL_compressed_texture_astc"),r!==null){if(n===Fu)return o===Ne?r.COMPRESSED_SRGB8_ALPHA8_ASTC_4x4_KHR:r.COMPRESSED_RGBA_ASTC_4x4_KHR;if(n===Uu)return o===Ne?r.COMPRESSED_SRGB8_ALPHA8_ASTC_5x4_KHR:r.COMPRESSED_RGBA_ASTC_5x4_KHR;if(n===Bu)return o===Ne?r.COMPRESSED_SRGB8_ALPHA8_ASTC_5x5_KHR:r.COMPRESSED_RGBA_ASTC_5x5_KHR;if(n===ku)return o===Ne?r.COMPRESSED_SRGB8_ALPHA8_ASTC_6x5_KHR:r.COMPRESSED_RGBA_ASTC_6x5_KHR;if(n===zu)return o===Ne?r.COMPRESSED_SRGB8_ALPHA8_ASTC_6x6_KHR:r.COMPRESSED_RGBA_ASTC_6x6_KHR;if(n===Vu)return o===Ne?r.COMPRESSED_SRGB8_ALPHA8_ASTC_8x5_KHR:r.COMPRESSED_RGBA_ASTC_8x5_KHR;if(n===Gu)return o===Ne?r.COMPRESSED_SRGB8_ALPHA8_ASTC_8x6_KHR:r.COMPRESSED_RGBA_ASTC_8x6_KHR;if(n===Hu)return o===Ne?r.COMPRESSED_SRGB8_ALPHA8_ASTC_8x8_KHR:r.COMPRESSED_RGBA_ASTC_8x8_KHR;if(n===Wu)return o===Ne?r.COMPRESSED_SRGB8_ALPHA8_ASTC_10x5_KHR:r.COMPRESSED_RGBA_ASTC_10x5_KHR;if(n===Xu)return o===Ne?r.COMPRESSED_SRGB8_ALPHA8_ASTC_10x6_KHR:r.COMPRESSED_RGBA_ASTC_10x6_KHR;if(n===qu)return o===Ne?r.COMPRESSED_SRGB8_ALPHA8_ASTC_10x8_KHR:r.COMPRESSED_RGBA_ASTC_10x8_KHR;if(n===ju)return o===Ne?r.COMPRESSED_SRGB8_ALPHA8_ASTC_10x10_KHR:r.COMPRESSED_RGBA_ASTC_10x10_KHR;if(n===Yu)return o===Ne?r.COMPRESSED_SRGB8_ALPHA8_ASTC_12x10_KHR:r.COMPRESSED_RGBA_ASTC_12x10_KHR;if(n===$u)return o===Ne?r.COMPRESSED_SRGB8_ALPHA8_ASTC_12x12_KHR:r.COMPRESSED_RGBA_ASTC_12x12_KHR}else return null;if(n===Ju||n===Ku||n===Zu)if(r=t.get("EXT_texture_compression_bptc"),r!==null){if(n===Ju)return o===Ne?r.COMPRESSED_SRGB_ALPHA_BPTC_UNORM_EXT:r.COMPRESSED_RGBA_BPTC_UNORM_EXT;if(n===Ku)return r.COMPRESSED_RGB_BPTC_SIGNED_FLOAT_EXT;if(n===Zu)return r.COMPRESSED_RGB_BPTC_UNSIGNED_FLOAT_EXT}else return null;if(n===Qu||n===td||n===nc||n===ed)if(r=t.get("EXT_texture_compression_rgtc"),r!==null){if(n===Qu)return r.COMPRESSED_RED_RGTC1_EXT;if(n===td)return r.COMPRESSED_SIGNED_RED_RGTC1_EXT;if(n===nc)return r.COMPRESSED_RED_GREEN_RGTC2_EXT;if(n===ed)return r.COMPRESSED_SIGNED_RED_GREEN_RGTC2_EXT}else return null;return n===xo?s.UNSIGNED_INT_24_8:s[n]!==void 0?s[n]:null}return{convert:e}}var $R=`
void main() {

	gl_Position = vec4( position, 1.0 );

}`,JR=`
uniform sampler2DArray depthColor;
uniform float depthWidth;
uniform float depthHeight;

void main() {

	vec2 coord = vec2( gl_FragCoord.x / depthWidth, gl_FragCoord.y / depthHeight );

	if ( coord.x >= 1.0 ) {

		gl_FragDepth = texture( depthColor, vec3( coord.x - 1.0, coord.y, 1 ) ).r;

	} else {

		gl_FragDepth = texture( depthColor, vec3( coord.x, coord.y, 0 ) ).r;

	}

}`,Fm=class{constructor(){this.texture=null,this.mesh=null,this.depthNear=0,this.depthFar=0}init(t,e){if(this.texture===null){let n=new Ll(t.texture);(t.depthNear!==e.depthNear||t.depthFar!==e.depthFar)&&(this.depthNear=t.depthNear,this.depthFar=t.depthFar),this.texture=n}}getMesh(t){if(this.texture!==null&&this.mesh===null){let e=t.cameras[0].viewport,n=new vi({vertexShader:$R,fragmentShader:JR,uniforms:{depthColor:{value:this.texture},depthWidth:{value:e.z},depthHeight:{value:e.w}}});this.mesh=new de(new hs(20,20),n)}return this.mesh}reset(){this.texture=null,this.mesh=null}getDepthTexture(){return this.texture}},Um=class extends ls{constructor(t,e){super();let n=this,i=null,r=1,o=null,a="local-floor",l=1,c=null,h=null,u=null,d=null,f=null,m=null,y=typeof XRWebGLBinding<"u",p=new Fm,g={},_=e.getContextAttributes(),w=null,v=null,A=[],S=[],x=new Xt,M=null,L=null,P=new Sn;P.viewport=new Se;let R=new Sn;R.viewport=new Se;let O=[P,R],k=new mu,N=null,W=null;this.cameraAutoUpdate=!0,this.enabled=!1,this.isPresenting=!1,this.getController=function(j){let rt=A[j];return rt===void 0&&(rt=new ga,A[j]=rt),rt.getTargetRaySpace()},this.getControllerGrip=function(j){let rt=A[j];return rt===void 0&&(rt=new ga,A[j]=rt),rt.getGripSpace()},this.getHand=function(j){let rt=A[j];return rt===void 0&&(rt=new ga,A[j]=rt),rt.getHandSpace()};function z(j){let rt=S.indexOf(j.inputSource);if(rt===-1)return;let nt=A[rt];nt!==void 0&&(nt.update(j.inputSource,j.frame,c||o),nt.dispatchEvent({type:j.type,data:j.inputSource}))}function H(){i.removeEventListener("select",z),i.removeEventListener("selectstart",z),i.removeEventListener("selectend",z),i.removeEventListener("squeeze",z),i.removeEventListener("squeezestart",z),i.removeEventListener("squeezeend",z),i.removeEventListener("end",H),i.removeEventListener("inputsourceschange",it);for(let j=0;j<A.length;j++){let rt=S[j];rt!==null&&(S[j]=null,A[j].disconnect(rt))}N=null,W=null,p.reset();for(let j in g)delete g[j];if(t.setRenderTarget(w),f=null,d=null,u=null,i=null,v=null,st.stop(),n.isPresenting=!1,t.setPixelRatio(M),t.setSize(x.width,x.height,!1),L!==null){let j=L.camera;j.fov=L.fov,j.zoom=L.zoom,j.updateProjectionMatrix(),L=null}n.dispatchEvent({type:"sessionend"})}this.setFramebufferScaleFactor=function(j){r=j,n.isPresenting===!0&&Yt("WebXRManager: Cannot change framebuffer scale while presenting.")},this.setReferenceSpaceType=function(j){a=j,n.isPresenting===!0&&Yt("WebXRManager: Cannot change reference space type while presenting.")},this.getReferenceSpace=function(){return c||o},this.setReferenceSpace=function(j){c=j},this.getBaseLayer=function(){return d!==null?d:f},this.getBinding=function(){return u===null&&y&&(u=new XRWebGLBinding(i,e)),u},this.getFrame=function(){return m},this.getSession=function(){return i},this.setSession=async function(j){if(i=j,i!==null){if(w=t.getRenderTarget(),i.addEventListener("select",z),i.addEventListener("selectstart",z),i.addEventListener("selectend",z),i.addEventListener("squeeze",z),i.addEventListener("squeezestart",z),i.addEventListener("squeezeend",z),i.addEventListener("end",H),i.addEventListener("inputsourceschange",it),_.xrCompatible!==!0&&await e.makeXRCompatible(),M=t.getPixelRatio(),t.getSize(x),y&&"createProjectionLayer"in XRWebGLBinding.prototype){let nt=null,lt=null,gt=null;_.depth&&(gt=_.stencil?e.DEPTH24_STENCIL8:e.DEPTH_COMPONENT24,nt=_.stencil?sr:Ks,lt=_.stencil?xo:us);let Ut={colorFormat:e.RGBA8,depthFormat:gt,scaleFactor:r};u=this.getBinding(),d=u.createProjectionLayer(Ut),i.updateRenderState({layers:[d]}),t.setPixelRatio(1),t.setSize(d.textureWidth,d.textureHeight,!1),v=new Fi(d.textureWidth,d.textureHeight,{format:Ji,type:Si,depthTexture:new Qs(d.textureWidth,d.textureHeight,lt,void 0,void 0,void 0,void 0,void 0,void 0,nt),stencilBuffer:_.stencil,colorSpace:t.outputColorSpace,samples:_.antialias?4:0,resolveDepthBuffer:d.ignoreDepthValues===!1,resolveStencilBuffer:d.ignoreDepthValues===!1,storeMultisampledDepthBuffer:d.ignoreDepthValues===!1,storeMultisampledStencilBuffer:d.ignoreDepthValues===!1})}else{let nt={antialias:_.antialias,alpha:!0,depth:_.depth,stencil:_.stencil,framebufferScaleFactor:r};f=new XRWebGLLayer(i,e,nt),i.updateRenderState({baseLayer:f}),t.setPixelRatio(1),t.setSize(f.framebufferWidth,f.framebufferHeight,!1),v=new Fi(f.framebufferWidth,f.framebufferHeight,{format:Ji,type:Si,colorSpace:t.outputColorSpace,stencilBuffer:_.stencil,resolveDepthBuffer:f.ignoreDepthValues===!1,resolveStencilBuffer:f.ignoreDepthValues===!1,storeMultisampledDepthBuffer:f.ignoreDepthValues===!1,storeMultisampledStencilBuffer:f.ignoreDepthValues===!1})}v.isXRRenderTarget=!0,this.setFoveation(l),c=null,o=await i.requestReferenceSpace(a),st.setContext(i),st.start(),n.isPresenting=!0,n.dispatchEvent({type:"sessionstart"})}},this.getEnvironmentBlendMode=function(){if(i!==null)return i.environmentBlendMode},this.getDepthTexture=function(){return p.getDepthTexture()};function it(j){for(let rt=0;rt<j.removed.length;rt++){let nt=j.removed[rt],lt=S.indexOf(nt);lt>=0&&(S[lt]=null,A[lt].disconnect(nt))}for(let rt=0;rt<j.added.length;rt++){let nt=j.added[rt],lt=S.indexOf(nt);if(lt===-1){for(let Ut=0;Ut<A.length;Ut++)if(Ut>=S.length){S.push(nt),lt=Ut;break}else if(S[Ut]===null){S[Ut]=nt,lt=Ut;break}if(lt===-1)break}let gt=A[lt];gt&&gt.connect(nt)}}function Y(j,rt){rt===null?j.matrixWorld.copy(j.matrix):j.matrixWorld.multiplyMatrices(rt.matrixWorld,j.matrix),j.matrixWorldInverse.copy(j.matrixWorld).invert()}this.updateCamera=function(j){if(i===null)return;let rt=j.near,nt=j.far;p.texture!==null&&(p.depthNear>0&&(rt=p.depthNear),p.depthFar>0&&(nt=p.depthFar)),k.near=R.near=P.near=rt,k.far=R.far=P.far=nt,(N!==k.near||W!==k.far)&&(i.updateRenderState({depthNear:k.near,depthFar:k.far}),N=k.near,W=k.far),k.layers.mask=j.layers.mask|6,P.layers.mask=k.layers.mask&-5,R.layers.mask=k.layers.mask&-3;let lt=j.parent,gt=k.cameras;Y(k,lt);for(let Ut=0;Ut<gt.length;Ut++)Y(gt[Ut],lt);k.projectionMatrix.copy(P.projectionMatrix),k.projectionMatrixInverse.copy(P.projectionMatrixInverse),L===null&&j.isPerspectiveCamera&&(L={camera:j,fov:j.fov,zoom:j.zoom}),K(j,k,lt)};function K(j,rt,nt){nt===null?j.matrix.copy(rt.matrixWorld):(j.matrix.copy(nt.matrixWorld),j.matrix.invert(),j.matrix.multiply(rt.matrixWorld)),j.matrix.decompose(j.position,j.quaternion,j.scale),j.updateMatrixWorld(!0),j.projectionMatrix.copy(rt.projectionMatrix),j.projectionMatrixInverse.copy(rt.projectionMatrixInverse),j.isPerspectiveCamera&&(j.fov=ro*2*Math.atan(1/j.projectionMatrix.elements[5]),j.zoom=1)}this.getCamera=function(){return k},this.getFoveation=function(){if(!(d===null&&f===null))return l},this.setFoveation=function(j){l=j,d!==null&&(d.fixedFoveation=j),f!==null&&f.fixedFoveation!==void 0&&(f.fixedFoveation=j)},this.hasDepthSensing=function(){return p.texture!==null},this.getDepthSensingMesh=function(){return p.getMesh(k)},this.getCameraTexture=function(j){return g[j]};let tt=null;function ht(j,rt){if(h=rt.getViewerPose(c||o),m=rt,h!==null){let nt=h.views;f!==null&&(t.setRenderTargetFramebuffer(v,f.framebuffer),t.setRenderTarget(v));let lt=!1;nt.length!==k.cameras.length&&(k.cameras.length=0,lt=!0);for(let zt=0;zt<nt.length;zt++){let ge=nt[zt],fe=null;if(f!==null)fe=f.getViewport(ge);else{let Ze=u.getViewSubImage(d,ge);fe=Ze.viewport,zt===0&&(t.setRenderTargetTextures(v,Ze.colorTexture,Ze.depthStencilTexture),t.setRenderTarget(v))}let re=O[zt];re===void 0&&(re=new Sn,re.layers.enable(zt),re.viewport=new Se,O[zt]=re),re.matrix.fromArray(ge.transform.matrix),re.matrix.decompose(re.position,re.quaternion,re.scale),re.projectionMatrix.fromArray(ge.projectionMatrix),re.projectionMatrixInverse.copy(re.projectionMatrix).invert(),re.viewport.set(fe.x,fe.y,fe.width,fe.height),zt===0&&(k.matrix.copy(re.matrix),k.matrix.decompose(k.position,k.quaternion,k.scale)),lt===!0&&k.cameras.push(re)}let gt=i.enabledFeatures;if(gt&&gt.includes("depth-sensing")&&i.depthUsage=="gpu-optimized"&&y){u=n.getBinding();let zt=u.getDepthInformation(nt[0]);zt&&zt.isValid&&zt.texture&&p.init(zt,i.renderState)}if(gt&&gt.includes("camera-access")&&y){t.state.unbindTexture(),u=n.getBinding();for(let zt=0;zt<nt.length;zt++){let ge=nt[zt].camera;if(ge){let fe=g[ge];fe||(fe=new Ll,g[ge]=fe);let re=u.getCameraImage(ge);fe.sourceTexture=re}}}}for(let nt=0;nt<A.length;nt++){let lt=S[nt],gt=A[nt];lt!==null&&gt!==void 0&&gt.update(lt,rt,c||o)}tt&&tt(j,rt),rt.detectedPlanes&&n.dispatchEvent({type:"planesdetected",data:rt}),m=null}let st=new Qx;st.setAnimationLoop(ht),this.setAnimationLoop=function(j){tt=j},this.dispose=function(){}}},KR=new Nt,cv=new se;cv.set(-1,0,0,0,1,0,0,0,1);function ZR(s,t){function e(p,g){p.matrixAutoUpdate===!0&&p.updateMatrix(),g.value.copy(p.matrix)}function n(p,g){g.color.getRGB(p.fogColor.value,wm(s)),g.isFog?(p.fogNear.value=g.near,p.fogFar.value=g.far):g.isFogExp2&&(p.fogDensity.value=g.density)}function i(p,g,_,w,v){g.isNodeMaterial?g.uniformsNeedUpdate=!1:g.isMeshBasicMaterial?r(p,g):g.isMeshLambertMaterial?(r(p,g),g.envMap&&(p.envMapIntensity.value=g.envMapIntensity)):g.isMeshToonMaterial?(r(p,g),u(p,g)):g.isMeshPhongMaterial?(r(p,g),h(p,g),g.envMap&&(p.envMapIntensity.value=g.envMapIntensity)):g.isMeshStandardMaterial?(r(p,g),d(p,g),g.isMeshPhysicalMaterial&&f(p,g,v)):g.isMeshMatcapMaterial?(r(p,g),m(p,g)):g.isMeshDepthMaterial?r(p,g):g.isMeshDistanceMaterial?(r(p,g),y(p,g)):g.isMeshNormalMaterial?r(p,g):g.isLineBasicMaterial?(o(p,g),g.isLineDashedMaterial&&a(p,g)):g.isPointsMaterial?l(p,g,_,w):g.isSpriteMaterial?c(p,g):g.isShadowMaterial?(p.color.value.copy(g.color),p.opacity.value=g.opacity):g.isShaderMaterial&&(g.uniformsNeedUpdate=!1)}function r(p,g){p.opacity.value=g.opacity,g.color&&p.diffuse.value.copy(g.color),g.emissive&&p.emissive.value.copy(g.emissive).multiplyScalar(g.emissiveIntensity),g.map&&(p.map.value=g.map,e(g.map,p.mapTransform)),g.alphaMap&&(p.alphaMap.value=g.alphaMap,e(g.alphaMap,p.alphaMapTransform)),g.bumpMap&&(p.bumpMap.value=g.bumpMap,e(g.bumpMap,p.bumpMapTransform),p.bumpScale.value=g.bumpScale,g.side===jn&&(p.bumpScale.value*=-1)),g.normalMap&&(p.normalMap.value=g.normalMap,e(g.normalMap,p.normalMapTransform),p.normalScale.value.copy(g.normalScale),g.side===jn&&p.normalScale.value.negate()),g.displacementMap&&(p.displacementMap.value=g.displacementMap,e(g.displacementMap,p.displacementMapTransform),p.displacementScale.value=g.displacementScale,p.displacementBias.value=g.displacementBias),g.emissiveMap&&(p.emissiveMap.value=g.emissiveMap,e(g.emissiveMap,p.emissiveMapTransform)),g.specularMap&&(p.specularMap.value=g.specularMap,e(g.specularMap,p.specularMapTransform)),g.alphaTest>0&&(p.alphaTest.value=g.alphaTest);let _=t.get(g),w=_.envMap,v=_.envMapRotation;w&&(p.envMap.value=w,p.envMapRotation.value.setFromMatrix4(KR.makeRotationFromEuler(v)).transpose(),w.isCubeTexture&&w.isRenderTargetTexture===!1&&p.envMapRotation.value.premultiply(cv),p.reflectivity.value=g.reflectivity,p.ior.value=g.ior,p.refractionRatio.value=g.refractionRatio),g.lightMap&&(p.lightMap.value=g.lightMap,p.lightMapIntensity.value=g.lightMapIntensity,e(g.lightMap,p.lightMapTransform)),g.aoMap&&(p.aoMap.value=g.aoMap,p.aoMapIntensity.value=g.aoMapIntensity,e(g.aoMap,p.aoMapTransform))}function o(p,g){p.diffuse.value.copy(g.color),p.opacity.value=g.opacity,g.map&&(p.map.value=g.map,e(g.map,p.mapTransform))}function a(p,g){p.dashSize.value=g.dashSize,p.totalSize.value=g.dashSize+g.gapSize,p.scale.value=g.scale}function l(p,g,_,w){p.diffuse.value.copy(g.color),p.opacity.value=g.opacity,p.size.value=g.size*_,p.scale.value=w*.5,g.map&&(p.map.value=g.map,e(g.map,p.uvTransform)),g.alphaMap&&(p.alphaMap.value=g.alphaMap,e(g.alphaMap,p.alphaMapTransform)),g.alphaTest>0&&(p.alphaTest.value=g.alphaTest)}function c(p,g){p.diffuse.value.copy(g.color),p.opacity.value=g.opacity,p.rotation.value=g.rotation,g.map&&(p.map.value=g.map,e(g.map,p.mapTransform)),g.alphaMap&&(p.alphaMap.value=g.alphaMap,e(g.alphaMap,p.alphaMapTransform)),g.alphaTest>0&&(p.alphaTest.value=g.alphaTest)}function h(p,g){p.specular.value.copy(g.specular),p.shininess.value=Math.max(g.shininess,1e-4)}function u(p,g){g.gradientMap&&(p.gradientMap.value=g.gradientMap)}function d(p,g){p.metalness.value=g.metalness,g.metalnessMap&&(p.metalnessMap.value=g.metalnessMap,e(g.metalnessMap,p.metalnessMapTransform)),p.roughness.value=g.roughness,g.roughnessMap&&(p.roughnessMap.value=g.roughnessMap,e(g.roughnessMap,p.roughnessMapTransform)),g.envMap&&(p.envMapIntensity.value=g.envMapIntensity)}function f(p,g,_){p.ior.value=g.ior,g.diffuseRoughness>0&&(p.diffuseRoughness.value=g.diffuseRoughness,g.diffuseRoughnessMap&&(p.diffuseRoughnessMap.value=g.diffuseRoughnessMap,e(g.diffuseRoughnessMap,p.diffuseRoughnessMapTransform))),g.sheen>0&&(p.sheenColor.value.copy(g.sheenColor).multiplyScalar(g.sheen),p.sheenRoughness.value=g.sheenRoughness,g.sheenColorMap&&(p.sheenColorMap.value=g.sheenColorMap,e(g.sheenColorMap,p.sheenColorMapTransform)),g.sheenRoughnessMap&&(p.sheenRoughnessMap.value=g.sheenRoughnessMap,e(g.sheenRoughnessMap,p.sheenRoughnessMapTransform))),g.clearcoat>0&&(p.clearcoat.value=g.clearcoat,p.clearcoatRoughness.value=g.clearcoatRoughness,g.clearcoatMap&&(p.clearcoatMap.value=g.clearcoatMap,e(g.clearcoatMap,p.clearcoatMapTransform)),g.clearcoatRoughnessMap&&(p.clearcoatRoughnessMap.value=g.clearcoatRoughnessMap,e(g.clearcoatRoughnessMap,p.clearcoatRoughnessMapTransform)),g.clearcoatNormalMap&&(p.clearcoatNormalMap.value=g.clearcoatNormalMap,e(g.clearcoatNormalMap,p.clearcoatNormalMapTransform),p.clearcoatNormalScale.value.copy(g.clearcoatNormalScale),g.side===jn&&p.clearcoatNormalScale.value.negate())),g.dispersion>0&&(p.dispersion.value=g.dispersion),g.retroreflectivity>0&&(p.retroreflectivity.value=g.retroreflectivity),g.iridescence>0&&(p.iridescence.value=g.iridescence,p.iridescenceIOR.value=g.iridescenceIOR,p.iridescenceThicknessMinimum.value=g.iridescenceThicknessMinimum,p.iridescenceThicknessMaximum.value=g.iridescenceThicknessMaximum,g.iridescenceMap&&(p.iridescenceMap.value=g.iridescenceMap,e(g.iridescenceMap,p.iridescenceMapTransform)),g.iridescenceThicknessMap&&(p.iridescenceThicknessMap.value=g.iridescenceThicknessMap,e(g.iridescenceThicknessMap,p.iridescenceThicknessMapTransform))),g.transmission>0&&(p.transmission.value=g.transmission,p.transmissionSamplerMap.value=_.texture,p.transmissionSamplerSize.value.set(_.width,_.height),g.transmissionMap&&(p.transmissionMap.value=g.transmissionMap,e(g.transmissionMap,p.transmissionMapTransform)),p.thickness.value=g.thickness,g.thicknessMap&&(p.thicknessMap.value=g.thicknessMap,e(g.thicknessMap,p.thicknessMapTransform)),p.attenuationDistance.value=g.attenuationDistance,p.attenuationColor.value.copy(g.attenuationColor)),g.anisotropy>0&&(p.anisotropyVector.value.set(g.anisotropy*Math.cos(g.anisotropyRotation),g.anisotropy*Math.sin(g.anisotropyRotation)),g.anisotropyMap&&(p.anisotropyMap.value=g.anisotropyMap,e(g.anisotropyMap,p.anisotropyMapTransform))),p.specularIntensity.value=g.specularIntensity,p.specularColor.value.copy(g.specularColor),g.specularColorMap&&(p.specularColorMap.value=g.specularColorMap,e(g.specularColorMap,p.specularColorMapTransform)),g.specularIntensityMap&&(p.specularIntensityMap.value=g.specularIntensityMap,e(g.specularIntensityMap,p.specularIntensityMapTransform))}function m(p,g){g.matcap&&(p.matcap.value=g.matcap)}function y(p,g){let _=t.get(g).light;p.referencePosition.value.setFromMatrixPosition(_.matrixWorld),p.nearDistance.value=_.shadow.camera.near,p.farDistance.value=_.shadow.camera.far}return{refreshFogUniforms:n,refreshMaterialUniforms:i}}function QR(s,t,e,n){let i={},r={};function o(_,w){let v=w.program;n.uniformBlockBinding(_,v,i[_.id])}function a(_,w){let v=i[_.id];v===void 0&&(m(_),v=l(_),i[_.id]=v,_.addEventListener("dispose",p));let A=w.program;n.updateUBOMapping(_,A);let S=t.render.frame;r[_.id]!==S&&(c(_),r[_.id]=S)}function l(_){let w=s.createBuffer(),v=_.__size,A=_.usage;return s.bindBuffer(s.UNIFORM_BUFFER,w),s.bufferData(s.UNIFORM_BUFFER,v,A),s.bindBuffer(s.UNIFORM_BUFFER,null),w}function c(_){let w=i[_.id],v=_.uniforms,A=_.__cache;s.bindBuffer(s.UNIFORM_BUFFER,w);for(let S=0,x=v.length;S<x;S++){let M=v[S];if(Array.isArray(M))for(let L=0,P=M.length;L<P;L++)h(M[L],S,L,A);else h(M,S,0,A)}s.bindBuffer(s.UNIFORM_BUFFER,null)}function h(_,w,v,A){if(d(_,w,v,A)===!0){let S=_.__offset,x=_.value;if(Array.isArray(x)){let M=0;for(let L=0;L<x.length;L++){let P=x[L],R=y(P,!0);u(P,_.__data,M),M+=R.storage/Float32Array.BYTES_PER_ELEMENT}}else u(x,_.__data,0);s.bufferSubData(s.UNIFORM_BUFFER,S,_.__data)}}function u(_,w,v){typeof _=="number"||typeof _=="boolean"?w[v]=_:_.isMatrix3?(w[v]=_.elements[0],w[v+1]=_.elements[1],w[v+2]=_.elements[2],w[v+3]=0,w[v+4]=_.elements[3],w[v+5]=_.elements[4],w[v+6]=_.elements[5],w[v+7]=0,w[v+8]=_.elements[6],w[v+9]=_.elements[7],w[v+10]=_.elements[8],w[v+11]=0):ArrayBuffer.isView(_)?w.set(_.subarray(0,w.length-v),v):_.toArray(w,v)}function d(_,w,v,A){let S=_.value,x=w+"_"+v;if(Array.isArray(S)){A[x]===void 0&&(A[x]=[]);let M=A[x],L=!1;for(let P=0;P<S.length;P++)f(S[P],M,P)===!0&&(L=!0);return L}return f(S,A,x)}function f(_,w,v){if(w[v]===void 0)return typeof _=="number"||typeof _=="boolean"?w[v]=_:ArrayBuffer.isView(_)?w[v]=_.slice():w[v]=_.clone(),!0;{let A=w[v];if(typeof _=="number"||typeof _=="boolean"){if(A!==_)return w[v]=_,!0}else{if(ArrayBuffer.isView(_))return!0;if(A.equals(_)===!1)return A.copy(_),!0}}return!1}function m(_){let w=_.uniforms,v=0,A=16;for(let x=0,M=w.length;x<M;x++){let L=Array.isArray(w[x])?w[x]:[w[x]];for(let P=0,R=L.length;P<R;P++){let O=L[P],k=Array.isArray(O.value)?O.value:[O.value],N=Array.isArray(w[x])||Array.isArray(O.value),W=v;for(let H=0,it=k.length;H<it;H++){let Y=k[H],K=y(Y,N),tt=v%A,ht=tt%K.boundary,st=tt+ht;v+=ht,st!==0&&A-st<K.storage&&(v+=A-st),H===0&&(W=v),v+=K.storage}let z=O.type==="int"?Int32Array:O.type==="uint"?Uint32Array:Float32Array;O.__data=new z((v-W)/Float32Array.BYTES_PER_ELEMENT),O.__offset=W}}let S=v%A;return S>0&&(v+=A-S),_.__size=v,_.__cache={},this}function y(_,w){let v={boundary:0,storage:0};return typeof _=="number"||typeof _=="boolean"?(v.boundary=4,v.storage=4):_.isVector2?(v.boundary=8,v.storage=8):_.isVector3||_.isColor?(v.boundary=16,v.storage=12):_.isVector4?(v.boundary=16,v.storage=16):_.isMatrix3?(v.boundary=16,v.storage=48):_.isMatrix4?(v.boundary=16,v.storage=64):_.isTexture?Yt("WebGLRenderer: Texture samplers can not be part of an uniforms group."):ArrayBuffer.isView(_)?(v.boundary=16,v.storage=_.byteLength):Yt("WebGLRenderer: Unsupported uniform value type.",_),w===!0&&(v.boundary=16,v.storage=Math.ceil(v.storage/16)*16),v}function p(_){let w=_.target;w.removeEventListener("dispose",p),s.deleteBuffer(i[w.id]),delete i[w.id],delete r[w.id]}function g(){for(let _ in i)s.deleteBuffer(i[_]);i={},r={}}return{bind:o,update:a,dispose:g}}var tP=new Uint16Array([12469,15057,12620,14925,13266,14620,13807,14376,14323,13990,14545,13625,14713,13328,14840,12882,14931,12528,14996,12233,15039,11829,15066,11525,15080,11295,15085,10976,15082,10705,15073,10495,13880,14564,13898,14542,13977,14430,14158,14124,14393,13732,14556,13410,14702,12996,14814,12596,14891,12291,14937,11834,14957,11489,14958,11194,14943,10803,14921,10506,14893,10278,14858,9960,14484,14039,14487,14025,14499,13941,14524,13740,14574,13468,14654,13106,14743,12678,14818,12344,14867,11893,14889,11509,14893,11180,14881,10751,14852,10428,14812,10128,14765,9754,14712,9466,14764,13480,14764,13475,14766,13440,14766,13347,14769,13070,14786,12713,14816,12387,14844,11957,14860,11549,14868,11215,14855,10751,14825,10403,14782,10044,14729,9651,14666,9352,14599,9029,14967,12835,14966,12831,14963,12804,14954,12723,14936,12564,14917,12347,14900,11958,14886,11569,14878,11247,14859,10765,14828,10401,14784,10011,14727,9600,14660,9289,14586,8893,14508,8533,15111,12234,15110,12234,15104,12216,15092,12156,15067,12010,15028,11776,14981,11500,14942,11205,14902,10752,14861,10393,14812,9991,14752,9570,14682,9252,14603,8808,14519,8445,14431,8145,15209,11449,15208,11451,15202,11451,15190,11438,15163,11384,15117,11274,15055,10979,14994,10648,14932,10343,14871,9936,14803,9532,14729,9218,14645,8742,14556,8381,14461,8020,14365,7603,15273,10603,15272,10607,15267,10619,15256,10631,15231,10614,15182,10535,15118,10389,15042,10167,14963,9787,14883,9447,14800,9115,14710,8665,14615,8318,14514,7911,14411,7507,14279,7198,15314,9675,15313,9683,15309,9712,15298,9759,15277,9797,15229,9773,15166,9668,15084,9487,14995,9274,14898,8910,14800,8539,14697,8234,14590,7790,14479,7409,14367,7067,14178,6621,15337,8619,15337,8631,15333,8677,15325,8769,15305,8871,15264,8940,15202,8909,15119,8775,15022,8565,14916,8328,14804,8009,14688,7614,14569,7287,14448,6888,14321,6483,14088,6171,15350,7402,15350,7419,15347,7480,15340,7613,15322,7804,15287,7973,15229,8057,15148,8012,15046,7846,14933,7611,14810,7357,14682,7069,14552,6656,14421,6316,14251,5948,14007,5528,15356,5942,15356,5977,15353,6119,15348,6294,15332,6551,15302,6824,15249,7044,15171,7122,15070,7050,14949,6861,14818,6611,14679,6349,14538,6067,14398,5651,14189,5311,13935,4958,15359,4123,15359,4153,15356,4296,15353,4646,15338,5160,15311,5508,15263,5829,15188,6042,15088,6094,14966,6001,14826,5796,14678,5543,14527,5287,14377,4985,14133,4586,13869,4257,15360,1563,15360,1642,15358,2076,15354,2636,15341,3350,15317,4019,15273,4429,15203,4732,15105,4911,14981,4932,14836,4818,14679,4621,14517,4386,14359,4156,14083,3795,13808,3437,15360,122,15360,137,15358,285,15355,636,15344,1274,15322,2177,15281,2765,15215,3223,15120,3451,14995,3569,14846,3567,14681,3466,14511,3305,14344,3121,14037,2800,13753,2467,15360,0,15360,1,15359,21,15355,89,15346,253,15325,479,15287,796,15225,1148,15133,1492,15008,1749,14856,1882,14685,1886,14506,1783,14324,1608,13996,1398,13702,1183]),Ps=null;function eP(){return Ps===null&&(Ps=new Ar(tP,16,16,Ir,ds),Ps.name="DFG_LUT",Ps.minFilter=Bn,Ps.magFilter=Bn,Ps.wrapS=pi,Ps.wrapT=pi,Ps.generateMipmaps=!1,Ps.needsUpdate=!0),Ps}var ad=class{constructor(t={}){let{canvas:e=Sx(),context:n=null,depth:i=!0,stencil:r=!1,alpha:o=!1,antialias:a=!1,premultipliedAlpha:l=!0,preserveDrawingBuffer:c=!1,powerPreference:h="default",failIfMajorPerformanceCaveat:u=!1,reversedDepthBuffer:d=!1,outputBufferType:f=Si}=t;this.isWebGLRenderer=!0;let m;if(n!==null){if(typeof WebGLRenderingContext<"u"&&n instanceof WebGLRenderingContext)throw new Error("THREE.WebGLRenderer: WebGL 1 is not supported since r163.");m=n.getContextAttributes().alpha}else m=o;let y=f,p=new Set([Tu,wu,Mu]),g=new Set([Si,us,Ra,xo,vu,bu]),_=new Uint32Array(4),w=new Int32Array(4),v={textures:[],min:[],max:[],resolution:[]},A=null,S=null,x=[],M=[],L=null;this.domElement=e,this.debug={checkShaderErrors:!0,diagnostics:{keywords:!1},onShaderError:null},this.autoClear=!0,this.autoClearColor=!0,this.autoClearDepth=!0,this.autoClearStencil=!0,this.sortObjects=!0,this.clippingPlanes=[],this.localClippingEnabled=!1,this.toneMapping=Cs,this.toneMappingExposure=1,this.transmissionResolutionScale=1;let P=this,R=!1,O=null,k=null,N=null,W=null;this._outputColorSpace=Te;let z=0,H=0,it=null,Y=-1,K=null,tt=new Se,ht=new Se,st=null,j=new Rt(0),rt=0,nt=e.width,lt=e.height,gt=1,Ut=null,Kt=null,zt=new Se(0,0,nt,lt),ge=new Se(0,0,nt,lt),fe=!1,re=new Er,Ze=new iu,He=!1,pn=!1,Ue=new Nt,Ln=new F,Me=new Se,Mn={background:null,fog:null,environment:null,overrideMaterial:null,isScene:!0},rn=!1;function mn(){return it===null?gt:1}let G=n;function Pt(C,X){return e.getContext(C,X)}let Zt,ae,wt,ke,Wt,Jt,I,T,$,mt,dt,vt,bt,ot,ct,_t,V,ut,at,Tt,xt,Mt,qt;try{let C={alpha:!0,depth:i,stencil:r,antialias:a,premultipliedAlpha:l,preserveDrawingBuffer:c,powerPreference:h,failIfMajorPerformanceCaveat:u};if("setAttribute"in e&&e.setAttribute("data-engine",`three.js r${"187"}`),e.addEventListener("webglcontextlost",Vt,!1),e.addEventListener("webglcontextrestored",ne,!1),e.addEventListener("webglcontextcreationerror",Ct,!1),G===null){let X="webgl2";if(G=Pt(X,C),G===null)throw Pt(X)?new Error("THREE.WebGLRenderer: Error creating WebGL context with your selected attributes."):new Error("THREE.WebGLRenderer: Error creating WebGL context.")}ee()}catch(C){throw e.removeEventListener("webglcontextlost",Vt,!1),e.removeEventListener("webglcontextrestored",ne,!1),e.removeEventListener("webglcontextcreationerror",Ct,!1),te("WebGLRenderer: "+C.message),C}function ee(){Zt=new dC(G),Zt.init(),xt=new YR(G,Zt),ae=new eC(G,Zt,t,xt),wt=new qR(G,Zt),ae.reversedDepthBuffer&&d&&wt.buffers.depth.setReversed(!0),k=G.createFramebuffer(),N=G.createFramebuffer(),W=G.createFramebuffer(),ke=new mC(G),Wt=new IR,Jt=new jR(G,Zt,wt,Wt,ae,xt,ke),I=new uC(P),T=new yA(G),Mt=new Q1(G,T),$=new fC(G,T,ke,Mt),mt=new yC(G,$,T,Mt,ke),ut=new gC(G,ae,Jt),ct=new nC(Wt),dt=new LR(P,I,Zt,ae,Mt,ct),vt=new ZR(P,Wt),bt=new DR,ot=new zR(Zt),V=new Z1(P,I,wt,mt,m,l),_t=new XR(P,mt,ae),qt=new QR(G,ke,ae,wt),at=new tC(G,Zt,ke),Tt=new pC(G,Zt,ke),ke.programs=dt.programs,P.capabilities=ae,P.extensions=Zt,P.properties=Wt,P.renderLists=bt,P.shadowMap=_t,P.state=wt,P.info=ke}y!==Si&&(L=new xC(y,e.width,e.height,a,i,r));let pt=new Um(P,G);this.xr=pt,this.getContext=function(){return G},this.getContextAttributes=function(){return G.getContextAttributes()},this.forceContextLoss=function(){let C=Zt.get("WEBGL_lose_context");C&&C.loseContext()},this.forceContextRestore=function(){let C=Zt.get("WEBGL_lose_context");C&&C.restoreContext()},this.getPixelRatio=function(){return gt},this.setPixelRatio=function(C){C!==void 0&&(gt=C,this.setSize(nt,lt,!1))},this.getSize=function(C){return C.set(nt,lt)},this.setSize=function(C,X,et=!0){if(pt.isPresenting){Yt("WebGLRenderer: Can't change size while VR device is presenting.");return}nt=C,lt=X,e.width=Math.floor(C*gt),e.height=Math.floor(X*gt),et===!0&&(e.style.width=C+"px",e.style.height=X+"px"),L!==null&&L.setSize(e.width,e.height),this.setViewport(0,0,C,X)},this.getDrawingBufferSize=function(C){return C.set(nt*gt,lt*gt).floor()},this.setDrawingBufferSize=function(C,X,et){nt=C,lt=X,gt=et,e.width=Math.floor(C*et),e.height=Math.floor(X*et),this.setViewport(0,0,C,X)},this.setEffects=function(C){if(y===Si){te("WebGLRenderer: setEffects() requires outputBufferType set to HalfFloatType or FloatType.");return}if(C){for(let X=0;X<C.length;X++)if(C[X].isOutputPass===!0){Yt("WebGLRenderer: OutputPass is not needed in setEffects(). Tone mapping and color space conversion are applied automatically.");break}}L.setEffects(C||[])},this.getCurrentViewport=function(C){return C.copy(tt)},this.getViewport=function(C){return C.copy(zt)},this.setViewport=function(C,X,et,J){C.isVector4?zt.set(C.x,C.y,C.z,C.w):zt.set(C,X,et,J),wt.viewport(tt.copy(zt).multiplyScalar(mn()).round())},this.getScissor=function(C){return C.copy(ge)},this.setScissor=function(C,X,et,J){C.isVector4?ge.set(C.x,C.y,C.z,C.w):ge.set(C,X,et,J),wt.scissor(ht.copy(ge).multiplyScalar(mn()).round())},this.getScissorTest=function(){return fe},this.setScissorTest=function(C){wt.setScissorTest(fe=C)},this.setOpaqueSort=function(C){Ut=C},this.setTransparentSort=function(C){Kt=C},this.getClearColor=function(C){return C.copy(V.getClearColor())},this.setClearColor=function(){V.setClearColor(...arguments)},this.getClearAlpha=function(){return V.getClearAlpha()},this.setClearAlpha=function(){V.setClearAlpha(...arguments)},this.clear=function(C=!0,X=!0,et=!0){let J=0;if(C){let Z=!1;if(it!==null){let At=it.texture.format;Z=p.has(At)}if(Z){let At=it.texture.type,It=g.has(At),Et=V.getClearColor(),Dt=V.getClearAlpha(),Ht=Et.r,ie=Et.g,ye=Et.b;It?(_[0]=Ht,_[1]=ie,_[2]=ye,_[3]=Dt,G.clearBufferuiv(G.COLOR,0,_)):(w[0]=Ht,w[1]=ie,w[2]=ye,w[3]=Dt,G.clearBufferiv(G.COLOR,0,w))}else J|=G.COLOR_BUFFER_BIT}X&&(J|=G.DEPTH_BUFFER_BIT,this.state.buffers.depth.setMask(!0)),et&&(J|=G.STENCIL_BUFFER_BIT,this.state.buffers.stencil.setMask(4294967295)),J!==0&&G.clear(J)},this.clearColor=function(){this.clear(!0,!1,!1)},this.clearDepth=function(){this.clear(!1,!0,!1)},this.clearStencil=function(){this.clear(!1,!1,!0)},this.setNodesHandler=function(C){C.setRenderer(this),O=C},this.dispose=function(){e.removeEventListener("webglcontextlost",Vt,!1),e.removeEventListener("webglcontextrestored",ne,!1),e.removeEventListener("webglcontextcreationerror",Ct,!1),V.dispose(),bt.dispose(),ot.dispose(),Jt.dispose(),Wt.dispose(),I.dispose(),mt.dispose(),$.dispose(),Mt.dispose(),qt.dispose(),dt.dispose(),pt.dispose(),pt.removeEventListener("sessionstart",yc),pt.removeEventListener("sessionend",fs),Ds.stop()};function Vt(C){C.preventDefault(),vl("WebGLRenderer: Context Lost."),R=!0}function ne(){vl("WebGLRenderer: Context Restored."),R=!1;let C=ke.autoReset,X=_t.enabled,et=_t.autoUpdate,J=_t.needsUpdate,Z=_t.type;ee(),ke.autoReset=C,_t.enabled=X,_t.autoUpdate=et,_t.needsUpdate=J,_t.type=Z}function Ct(C){te("WebGLRenderer: A WebGL context could not be created. Reason: ",C.statusMessage)}function ce(C){let X=C.target;X.removeEventListener("dispose",ce),Xe(X)}function Xe(C){oi(C),Wt.remove(C)}function oi(C){let X=Wt.get(C).programs;X!==void 0&&(X.forEach(function(et){dt.releaseProgram(et)}),C.isShaderMaterial&&dt.releaseShaderCache(C))}this.renderBufferDirect=function(C,X,et,J,Z,At){X===null&&(X=Mn);let It=Z.isMesh&&Z.matrixWorld.determinantAffine()<0,Et=Ga(C,X,et,J,Z);wt.setMaterial(J,It);let Dt=et.index,Ht=1;if(J.wireframe===!0){if(Dt=$.getWireframeAttribute(et),Dt===void 0)return;Ht=2}let ie=et.drawRange,ye=et.attributes.position,Gt=ie.start*Ht,_e=(ie.start+ie.count)*Ht;At!==null&&(Gt=Math.max(Gt,At.start*Ht),_e=Math.min(_e,(At.start+At.count)*Ht)),Dt!==null?(Gt=Math.max(Gt,0),_e=Math.min(_e,Dt.count)):ye!=null&&(Gt=Math.max(Gt,0),_e=Math.min(_e,ye.count));let en=_e-Gt;if(en<0||en===1/0)return;Mt.setup(Z,J,Et,et,Dt);let De,Oe=at;if(Dt!==null&&(De=T.get(Dt),Oe=Tt,Oe.setIndex(De)),Z.isMesh)J.wireframe===!0?(wt.setLineWidth(J.wireframeLinewidth*mn()),Oe.setMode(G.LINES)):Oe.setMode(G.TRIANGLES);else if(Z.isLine){let wn=J.linewidth;wn===void 0&&(wn=1),wt.setLineWidth(wn*mn()),Z.isLineSegments?Oe.setMode(G.LINES):Z.isLineLoop?Oe.setMode(G.LINE_LOOP):Oe.setMode(G.LINE_STRIP)}else Z.isPoints?Oe.setMode(G.POINTS):Z.isSprite&&Oe.setMode(G.TRIANGLES);if(Z.isBatchedMesh)if(Zt.get("WEBGL_multi_draw"))Oe.renderMultiDraw(Z._multiDrawStarts,Z._multiDrawCounts,Z._multiDrawCount);else{let wn=Z._multiDrawStarts,Bt=Z._multiDrawCounts,gn=Z._multiDrawCount,ve=Dt?T.get(Dt).bytesPerElement:1,Fs=Wt.get(J).currentProgram.getUniforms();for(let yn=0;yn<gn;yn++)Fs.setValue(G,"_gl_DrawID",yn),Oe.render(wn[yn]/ve,Bt[yn])}else if(Z.isInstancedMesh)Oe.renderInstances(Gt,en,Z.count);else if(et.isInstancedBufferGeometry){let wn=et._maxInstanceCount!==void 0?et._maxInstanceCount:1/0,Bt=Math.min(et.instanceCount,wn);Oe.renderInstances(Gt,en,Bt)}else Oe.render(Gt,en)};function ka(C,X,et,J){O!==null&&C.isNodeMaterial&&O.setObject(J,C),He===!0&&ct.setState(C,et,!1),C.transparent===!0&&C.side===yi&&C.forceSinglePass===!1?(C.side=jn,C.needsUpdate=!0,ps(C,X,J),C.side=Es,C.needsUpdate=!0,ps(C,X,J),C.side=yi):ps(C,X,J)}this.compile=function(C,X,et=null){et===null&&(et=C),O!==null&&O.renderStart(C,X,et),S=ot.get(et),S.init(X),M.push(S),et.traverseVisible(function(Z){Z.isLight&&Z.layers.test(X.layers)&&(S.pushLight(Z),Z.castShadow&&S.pushShadow(Z))}),C!==et&&C.traverseVisible(function(Z){Z.isLight&&Z.layers.test(X.layers)&&(S.pushLight(Z),Z.castShadow&&S.pushShadow(Z))}),S.setupLights(),O!==null&&O.updateLights(S.state.lightsArray),pn=this.localClippingEnabled,He=ct.init(this.clippingPlanes,pn),He===!0&&ct.setGlobalState(this.clippingPlanes,X),O!==null&&_t.render(S.state.shadowsArray,et,X);let J=new Set;return C.traverse(function(Z){if(!(Z.isMesh||Z.isPoints||Z.isLine||Z.isSprite))return;let At=Z.material;if(At)if(Array.isArray(At))for(let It=0;It<At.length;It++){let Et=At[It];ka(Et,et,X,Z),J.add(Et)}else ka(At,et,X,Z),J.add(At)}),S=M.pop(),O!==null&&O.renderEnd(),J},this.compileAsync=function(C,X,et=null){let J=this.compile(C,X,et);return new Promise(Z=>{function At(){if(J.forEach(function(It){let Dt=Wt.get(It).currentProgram;(Dt===void 0||Dt.isReady())&&J.delete(It)}),J.size===0){Z(C);return}setTimeout(At,10)}Zt.get("KHR_parallel_shader_compile")!==null?At():setTimeout(At,10)})};let wo=null;function rf(C){wo&&wo(C)}function yc(){Ds.stop()}function fs(){Ds.start()}let Ds=new Qx;Ds.setAnimationLoop(rf),typeof self<"u"&&Ds.setContext(self),this.setAnimationLoop=function(C){wo=C,pt.setAnimationLoop(C),C===null?Ds.stop():Ds.start()},pt.addEventListener("sessionstart",yc),pt.addEventListener("sessionend",fs),this.render=function(C,X){if(X!==void 0&&X.isCamera!==!0){te("WebGLRenderer.render: camera is not an instance of THREE.Camera.");return}if(R===!0)return;O!==null&&O.renderStart(C,X);let et=pt.enabled===!0&&pt.isPresenting===!0,J=L!==null&&(it===null||et)&&L.begin(P,it);if(C.matrixWorldAutoUpdate===!0&&C.updateMatrixWorld(),X.parent===null&&X.matrixWorldAutoUpdate===!0&&X.updateMatrixWorld(),pt.enabled===!0&&pt.isPresenting===!0&&(L===null||L.isCompositing()===!1)&&(pt.cameraAutoUpdate===!0&&pt.updateCamera(X),X=pt.getCamera()),C.isScene===!0&&C.onBeforeRender(P,C,X,it),S=ot.get(C,M.length),S.init(X),S.state.textureUnits=Jt.getTextureUnits(),M.push(S),Ue.multiplyMatrices(X.projectionMatrix,X.matrixWorldInverse),X.isArrayCamera?Ze.setFromArrayCamera(X):re.setFromProjectionMatrix(Ue,ji,X.reversedDepth),pn=this.localClippingEnabled,He=ct.init(this.clippingPlanes,pn),A=bt.get(C,x.length),A.init(),x.push(A),this.info.render.frame++,pt.enabled===!0&&pt.isPresenting===!0){let It=P.xr.getDepthSensingMesh();It!==null&&Os(It,X,-1/0,P.sortObjects)}Os(C,X,0,P.sortObjects),A.finish(),O!==null&&O.updateLights(S.state.lightsArray),P.sortObjects===!0&&A.sort(Ut,Kt),rn=pt.enabled===!1||pt.isPresenting===!1||pt.hasDepthSensing()===!1,rn&&V.addToRenderList(A,C),this.info.autoReset===!0&&this.info.reset(),He===!0&&ct.beginShadows();let Z=S.state.shadowsArray;if(_t.render(Z,C,X),He===!0&&ct.endShadows(),(J&&L.hasRenderPass())===!1){let It=A.opaque,Et=A.transmissive;if(S.setupLights(),X.isArrayCamera){let Dt=X.cameras;if(Et.length>0)for(let Ht=0,ie=Dt.length;Ht<ie;Ht++){let ye=Dt[Ht];Zi(It,Et,C,ye)}rn&&V.render(C);for(let Ht=0,ie=Dt.length;Ht<ie;Ht++){let ye=Dt[Ht];za(A,C,ye,ye.viewport)}}else Et.length>0&&Zi(It,Et,C,X),rn&&V.render(C),za(A,C,X)}it!==null&&H===0&&(Jt.updateMultisampleRenderTarget(it),Jt.updateRenderTargetMipmap(it)),J&&L.end(P),C.isScene===!0&&C.onAfterRender(P,C,X),Mt.resetDefaultState(),Y=-1,K=null,M.pop(),M.length>0?(S=M[M.length-1],Jt.setTextureUnits(S.state.textureUnits),He===!0&&ct.setGlobalState(P.clippingPlanes,S.state.camera)):S=null,x.pop(),x.length>0?A=x[x.length-1]:A=null,O!==null&&O.renderEnd()};function Os(C,X,et,J){if(C.visible===!1)return;if(C.layers.test(X.layers)){if(C.isGroup)et=C.renderOrder;else if(C.isLOD)C.autoUpdate===!0&&C.update(X);else if(C.isLight)S.pushLight(C),C.castShadow&&S.pushShadow(C);else if(C.isSprite){let It=X.isArrayCamera?Ze:re;if(!C.frustumCulled||C.intersectsFrustum(It)){J&&Me.setFromMatrixPosition(C.matrixWorld).applyMatrix4(Ue);let Et=mt.update(C),Dt=C.material;Dt.visible&&A.push(C,Et,Dt,et,Me.z,null,X)}}else if(C.isMesh||C.isLine||C.isPoints){let It=X.isArrayCamera?Ze:re;if(!C.frustumCulled||C.intersectsFrustum(It)){let Et=mt.update(C),Dt=C.material;if(J&&(C.boundingSphere!==void 0?(C.boundingSphere===null&&C.computeBoundingSphere(),Me.copy(C.boundingSphere.center)):(Et.boundingSphere===null&&Et.computeBoundingSphere(),Me.copy(Et.boundingSphere.center)),Me.applyMatrix4(C.matrixWorld).applyMatrix4(Ue)),Array.isArray(Dt)){let Ht=Et.groups;for(let ie=0,ye=Ht.length;ie<ye;ie++){let Gt=Ht[ie],_e=Dt[Gt.materialIndex];_e&&_e.visible&&A.push(C,Et,_e,et,Me.z,Gt,X)}}else Dt.visible&&A.push(C,Et,Dt,et,Me.z,null,X)}}}let At=C.children;for(let It=0,Et=At.length;It<Et;It++)Os(At[It],X,et,J)}function za(C,X,et,J){let{opaque:Z,transmissive:At,transparent:It}=C;S.setupLightsView(et),He===!0&&ct.setGlobalState(P.clippingPlanes,et),J&&wt.viewport(tt.copy(J)),Z.length>0&&on(Z,X,et),At.length>0&&on(At,X,et),It.length>0&&on(It,X,et),wt.buffers.depth.setTest(!0),wt.buffers.depth.setMask(!0),wt.buffers.color.setMask(!0),wt.setPolygonOffset(!1)}function Zi(C,X,et,J){if((et.isScene===!0?et.overrideMaterial:null)!==null)return;if(S.state.transmissionRenderTarget[J.id]===void 0){let Gt=Zt.has("EXT_color_buffer_half_float")||Zt.has("EXT_color_buffer_float");S.state.transmissionRenderTarget[J.id]=new Fi(1,1,{generateMipmaps:!0,type:Gt?ds:Si,minFilter:$i,samples:Math.max(4,ae.samples),stencilBuffer:r,resolveDepthBuffer:!1,resolveStencilBuffer:!1,storeMultisampledDepthBuffer:!1,storeMultisampledStencilBuffer:!1,colorSpace:ue.workingColorSpace})}let At=S.state.transmissionRenderTarget[J.id],It=J.viewport||tt;At.setSize(It.z*P.transmissionResolutionScale,It.w*P.transmissionResolutionScale);let Et=P.getRenderTarget(),Dt=P.getActiveCubeFace(),Ht=P.getActiveMipmapLevel();P.setRenderTarget(At),P.getClearColor(j),rt=P.getClearAlpha(),rt<1&&P.setClearColor(16777215,.5),P.clear(),rn&&V.render(et);let ie=P.toneMapping;P.toneMapping=Cs;let ye=J.viewport;if(J.viewport!==void 0&&(J.viewport=void 0),S.setupLightsView(J),He===!0&&ct.setGlobalState(P.clippingPlanes,J),on(C,et,J),Jt.updateMultisampleRenderTarget(At),Jt.updateRenderTargetMipmap(At),Zt.has("WEBGL_multisampled_render_to_texture")===!1){let Gt=!1;for(let _e=0,en=X.length;_e<en;_e++){let De=X[_e],{object:Oe,geometry:wn,material:Bt,group:gn}=De;if(Bt.side===yi&&Oe.layers.test(J.layers)){let ve=Bt.side;Bt.side=jn,Bt.needsUpdate=!0,un(Oe,et,J,wn,Bt,gn),Bt.side=ve,Bt.needsUpdate=!0,Gt=!0}}Gt===!0&&(Jt.updateMultisampleRenderTarget(At),Jt.updateRenderTargetMipmap(At))}P.setRenderTarget(Et,Dt,Ht),P.setClearColor(j,rt),ye!==void 0&&(J.viewport=ye),P.toneMapping=ie}function on(C,X,et){let J=X.isScene===!0?X.overrideMaterial:null;for(let Z=0,At=C.length;Z<At;Z++){let It=C[Z],{object:Et,geometry:Dt,group:Ht}=It,ie=It.material;ie.allowOverride===!0&&J!==null&&(ie=J),Et.layers.test(et.layers)&&un(Et,X,et,Dt,ie,Ht)}}function un(C,X,et,J,Z,At){O!==null&&Z.isNodeMaterial&&O.setObject(C,Z),C.onBeforeRender(P,X,et,J,Z,At),C.modelViewMatrix.multiplyMatrices(et.matrixWorldInverse,C.matrixWorld),C.normalMatrix.getNormalMatrix(C.modelViewMatrix),Z.onBeforeRender(P,X,et,J,C,At),Z.transparent===!0&&Z.side===yi&&Z.forceSinglePass===!1?(Z.side=jn,Z.needsUpdate=!0,P.renderBufferDirect(et,X,J,Z,C,At),Z.side=Es,Z.needsUpdate=!0,P.renderBufferDirect(et,X,J,Z,C,At),Z.side=yi):P.renderBufferDirect(et,X,J,Z,C,At),C.onAfterRender(P,X,et,J,Z,At)}function dn(C){let X=0;for(let et of C)et.texture!==null&&X++;return X}function ps(C,X,et){X.isScene!==!0&&(X=Mn);let J=Wt.get(C),Z=S.state.lights,At=S.state.shadowsArray,It=Z.state.version,Et=dt.getParameters(C,Z.state,At,X,et,S.state.lightProbeGridArray),Dt=dt.getProgramCacheKey(Et),Ht=J.programs;J.environment=C.isMeshStandardMaterial||C.isMeshLambertMaterial||C.isMeshPhongMaterial?X.environment:null,J.fog=X.fog;let ie=C.isMeshStandardMaterial||C.isMeshLambertMaterial&&!C.envMap||C.isMeshPhongMaterial&&!C.envMap;J.envMap=I.get(C.envMap||J.environment,ie),J.envMapRotation=J.environment!==null&&C.envMap===null?X.environmentRotation:C.envMapRotation,Ht===void 0&&(C.addEventListener("dispose",ce),Ht=new Map,J.programs=Ht,J.programVariants=new Map);let ye=Ht.get(Dt);if(ye!==void 0){if(J.currentProgram===ye&&J.lightsStateVersion===It)return Va(C,Et),ye}else Et.uniforms=dt.getUniforms(C),O!==null&&C.isNodeMaterial&&O.build(C,et,Et),C.onBeforeCompile(Et,P),ye=dt.acquireProgram(Et,Dt),Ht.set(Dt,ye),J.uniforms=Et.uniforms;let Gt=J.uniforms;return(!C.isShaderMaterial&&!C.isRawShaderMaterial||C.clipping===!0)&&(Gt.clippingPlanes=ct.uniform),Va(C,Et),J.needsLights=ur(C),J.lightsStateVersion=It,J.needsLights&&(Gt.ambientLightColor.value=Z.state.ambient,Gt.lightProbe.value=Z.state.probe,Gt.sunLights.value=Z.state.sun,Gt.sunLightShadows.value=Z.state.sunShadow,Gt.directionalLights.value=Z.state.directional,Gt.directionalLightShadows.value=Z.state.directionalShadow,Gt.spotLights.value=Z.state.spot,Gt.spotLightShadows.value=Z.state.spotShadow,Gt.rectAreaLights.value=Z.state.rectArea,Gt.ltc_1.value=Z.state.rectAreaLTC1,Gt.ltc_2.value=Z.state.rectAreaLTC2,Gt.pointLights.value=Z.state.point,Gt.pointLightShadows.value=Z.state.pointShadow,Gt.hemisphereLights.value=Z.state.hemi,Gt.sunShadowMatrix.value=Z.state.sunShadowMatrix,Gt.sunShadowCascade.value=Z.state.sunShadowCascade,Gt.directionalShadowMatrix.value=Z.state.directionalShadowMatrix,Gt.spotLightMatrix.value=Z.state.spotLightMatrix,Gt.spotLightMap.value=Z.state.spotLightMap,Gt.pointShadowMatrix.value=Z.state.pointShadowMatrix),J.numLightProbeGrids=dn(S.state.lightProbeGridArray),J.currentProgram=ye,J.uniformsList=null,ye}function Ti(C,X,et,J,Z){let At=Wt.get(C),It=At.currentProgram.id+","+J+","+Z,Et=At.programVariants.get(It);return Et===void 0?(Et=ps(C,X,et),At.programVariants.set(It,Et)):(At.currentProgram=Et,At.uniformsList=null,At.outputColorSpace=J,At.toneMapping=Z),Et}function hr(C){if(C.uniformsList===null){let X=C.currentProgram.getUniforms();C.uniformsList=Pa.seqWithValue(X.seq,C.uniforms)}return C.uniformsList}function Va(C,X){let et=Wt.get(C);et.outputColorSpace=X.outputColorSpace,et.batching=X.batching,et.batchingColor=X.batchingColor,et.instancing=X.instancing,et.instancingColor=X.instancingColor,et.instancingMorph=X.instancingMorph,et.skinning=X.skinning,et.morphTargets=X.morphTargets,et.morphNormals=X.morphNormals,et.morphColors=X.morphColors,et.morphTargetsCount=X.morphTargetsCount,et.numClippingPlanes=X.numClippingPlanes,et.numIntersection=X.numClipIntersection,et.vertexAlphas=X.vertexAlphas,et.vertexTangents=X.vertexTangents,et.toneMapping=X.toneMapping}function Ga(C,X,et,J,Z){X.isScene!==!0&&(X=Mn),Jt.resetTextureUnits();let At=X.fog,It=J.isMeshStandardMaterial||J.isMeshLambertMaterial||J.isMeshPhongMaterial?X.environment:null,Et=it===null?P.outputColorSpace:it.isXRRenderTarget===!0?it.texture.colorSpace:ue.workingColorSpace,Dt=J.isMeshStandardMaterial||J.isMeshLambertMaterial&&!J.envMap||J.isMeshPhongMaterial&&!J.envMap,Ht=I.get(J.envMap||It,Dt),ie=J.vertexColors===!0&&!!et.attributes.color&&et.attributes.color.itemSize===4,ye=!!et.attributes.tangent&&(!!J.normalMap||J.anisotropy>0),Gt=!!et.morphAttributes.position,_e=!!et.morphAttributes.normal,en=!!et.morphAttributes.color,De=Cs;J.toneMapped&&(it===null||it.isXRRenderTarget===!0)&&(De=P.toneMapping);let Oe=et.morphAttributes.position||et.morphAttributes.normal||et.morphAttributes.color,wn=Oe!==void 0?Oe.length:0,Bt=Wt.get(J),gn=S.state.lights;if(He===!0&&(pn===!0||C!==K)){let Fe=C===K&&J.id===Y;ct.setState(J,C,Fe)}let ve=!1,Fs=!1;J.version===Bt.__version?Bt.needsLights&&Bt.lightsStateVersion!==gn.state.version||Z.isBatchedMesh&&Bt.batching===!1||!Z.isBatchedMesh&&Bt.batching===!0||Z.isBatchedMesh&&Bt.batchingColor===!0&&Z._colorsTexture===null||Z.isBatchedMesh&&Bt.batchingColor===!1&&Z._colorsTexture!==null||Z.isInstancedMesh&&Bt.instancing===!1||!Z.isInstancedMesh&&Bt.instancing===!0||Z.isSkinnedMesh&&Bt.skinning===!1||!Z.isSkinnedMesh&&Bt.skinning===!0||Z.isInstancedMesh&&Bt.instancingColor===!0&&Z.instanceColor===null||Z.isInstancedMesh&&Bt.instancingColor===!1&&Z.instanceColor!==null||Z.isInstancedMesh&&Bt.instancingMorph===!0&&Z.morphTexture===null||Z.isInstancedMesh&&Bt.instancingMorph===!1&&Z.morphTexture!==null||Bt.envMap!==Ht||J.fog===!0&&Bt.fog!==At||Bt.numClippingPlanes!==void 0&&(Bt.numClippingPlanes!==ct.numPlanes||Bt.numIntersection!==ct.numIntersection)||Bt.vertexAlphas!==ie||Bt.vertexTangents!==ye||Bt.morphTargets!==Gt||Bt.morphNormals!==_e||Bt.morphColors!==en||Bt.morphTargetsCount!==wn||Bt.numLightProbeGrids!==dn(S.state.lightProbeGridArray)?ve=!0:(Bt.outputColorSpace!==Et||Bt.toneMapping!==De)&&(Fs=!0):(ve=!0,Bt.__version=J.version);let yn=Bt.currentProgram;(ve===!0||Fs===!0)&&(yn=Fs===!0?Ti(J,X,Z,Et,De):ps(J,X,Z),O&&J.isNodeMaterial&&O.onUpdateProgram(J,yn,Bt));let Eo=!1,ms=!1,Us=!1,pe=yn.getUniforms(),an=Bt.uniforms;if(wt.useProgram(yn.program)&&(Eo=!0,ms=!0,Us=!0),J.id!==Y&&(Y=J.id,ms=!0),Eo||K!==C){wt.buffers.depth.getReversed()&&C.reversedDepth!==!0&&(C._reversedDepth=!0,C.updateProjectionMatrix()),pe.setValue(G,"projectionMatrix",C.projectionMatrix),pe.setValue(G,"viewMatrix",C.matrixWorldInverse);let _n=pe.map.cameraPosition;_n!==void 0&&_n.setValue(G,Ln.setFromMatrixPosition(C.matrixWorld)),ae.logarithmicDepthBuffer&&pe.setValue(G,"logDepthBufFC",2/(Math.log(C.far+1)/Math.LN2)),(J.isMeshPhongMaterial||J.isMeshToonMaterial||J.isMeshLambertMaterial||J.isMeshBasicMaterial||J.isMeshStandardMaterial||J.isShaderMaterial)&&pe.setValue(G,"isOrthographic",C.isOrthographicCamera===!0),K!==C&&(K=C,ms=!0,Us=!0)}if(Bt.needsLights&&(gn.state.sunShadowMap.length>0&&pe.setValue(G,"sunShadowMap",gn.state.sunShadowMap,Jt),gn.state.directionalShadowMap.length>0&&pe.setValue(G,"directionalShadowMap",gn.state.directionalShadowMap,Jt),gn.state.spotShadowMap.length>0&&pe.setValue(G,"spotShadowMap",gn.state.spotShadowMap,Jt),gn.state.pointShadowMap.length>0&&pe.setValue(G,"pointShadowMap",gn.state.pointShadowMap,Jt)),Z.isSkinnedMesh){pe.setOptional(G,Z,"bindMatrix"),pe.setOptional(G,Z,"bindMatrixInverse");let Fe=Z.skeleton;Fe&&(Fe.boneTexture===null&&Fe.computeBoneTexture(),pe.setValue(G,"boneTexture",Fe.boneTexture,Jt))}Z.isBatchedMesh&&(pe.setOptional(G,Z,"batchingTexture"),pe.setValue(G,"batchingTexture",Z._matricesTexture,Jt),pe.setOptional(G,Z,"batchingIdTexture"),pe.setValue(G,"batchingIdTexture",Z._indirectTexture,Jt),pe.setOptional(G,Z,"batchingColorTexture"),Z._colorsTexture!==null&&pe.setValue(G,"batchingColorTexture",Z._colorsTexture,Jt));let ai=et.morphAttributes;if((ai.position!==void 0||ai.normal!==void 0||ai.color!==void 0)&&ut.update(Z,et,yn),(ms||Bt.receiveShadow!==Z.receiveShadow)&&(Bt.receiveShadow=Z.receiveShadow,pe.setValue(G,"receiveShadow",Z.receiveShadow)),(J.isMeshStandardMaterial||J.isMeshLambertMaterial||J.isMeshPhongMaterial)&&J.envMap===null&&X.environment!==null&&(an.envMapIntensity.value=X.environmentIntensity),an.dfgLUT!==void 0&&(an.dfgLUT.value=eP()),ms){if(pe.setValue(G,"toneMappingExposure",P.toneMappingExposure),Bt.needsLights&&To(an,Us),At&&J.fog===!0&&vt.refreshFogUniforms(an,At),vt.refreshMaterialUniforms(an,J,gt,lt,S.state.transmissionRenderTarget[C.id]),Bt.needsLights&&Bt.numLightProbeGrids>0){let Fe=v,_n=0;for(let Zn of S.state.lightProbeGridArray)Zn.texture!==null&&(Fe.textures[_n]=Zn.texture,Fe.min[_n]=Zn.boundingBox.min,Fe.max[_n]=Zn.boundingBox.max,Fe.resolution[_n]=Zn.resolution,_n++);for(let Zn in Fe)Fe[Zn].length=_n;an.probesSH.value=Fe.textures,an.probesMin.value=Fe.min,an.probesMax.value=Fe.max,an.probesResolution.value=Fe.resolution}Pa.upload(G,hr(Bt),an,Jt)}if(J.isShaderMaterial&&J.uniformsNeedUpdate===!0&&(Pa.upload(G,hr(Bt),an,Jt),J.uniformsNeedUpdate=!1),J.isSpriteMaterial&&pe.setValue(G,"center",Z.center),pe.setValue(G,"modelViewMatrix",Z.modelViewMatrix),pe.setValue(G,"normalMatrix",Z.normalMatrix),pe.setValue(G,"modelMatrix",Z.matrixWorld),J.uniformsGroups!==void 0){let Fe=J.uniformsGroups;for(let _n=0,Zn=Fe.length;_n<Zn;_n++){let _c=Fe[_n];qt.update(_c,yn),qt.bind(_c,yn)}}return yn}function To(C,X){C.ambientLightColor.needsUpdate=X,C.lightProbe.needsUpdate=X,C.sunLights.needsUpdate=X,C.sunLightShadows.needsUpdate=X,C.directionalLights.needsUpdate=X,C.directionalLightShadows.needsUpdate=X,C.pointLights.needsUpdate=X,C.pointLightShadows.needsUpdate=X,C.spotLights.needsUpdate=X,C.spotLightShadows.needsUpdate=X,C.rectAreaLights.needsUpdate=X,C.hemisphereLights.needsUpdate=X}function ur(C){return C.isMeshLambertMaterial||C.isMeshToonMaterial||C.isMeshPhongMaterial||C.isMeshStandardMaterial||C.isShadowMaterial||C.isShaderMaterial&&C.lights===!0}this.getActiveCubeFace=function(){return z},this.getActiveMipmapLevel=function(){return H},this.getRenderTarget=function(){return it},this.setRenderTargetTextures=function(C,X,et){let J=Wt.get(C);J.__autoAllocateDepthBuffer=C.resolveDepthBuffer===!1,J.__autoAllocateDepthBuffer===!1&&(J.__useRenderToTexture=!1),Wt.get(C.texture).__webglTexture=X,Wt.get(C.depthTexture).__webglTexture=J.__autoAllocateDepthBuffer?void 0:et,J.__hasExternalTextures=!0},this.setRenderTargetFramebuffer=function(C,X){let et=Wt.get(C);et.__webglFramebuffer=X,et.__useDefaultFramebuffer=X===void 0},this.setRenderTarget=function(C,X=0,et=0){it=C,z=X,H=et;let J=null,Z=!1,At=!1;if(C){let Et=Wt.get(C);if(Et.__useDefaultFramebuffer!==void 0){wt.bindFramebuffer(G.FRAMEBUFFER,Et.__webglFramebuffer),tt.copy(C.viewport),ht.copy(C.scissor),st=C.scissorTest,wt.viewport(tt),wt.scissor(ht),wt.setScissorTest(st),Y=-1;return}else if(Et.__webglFramebuffer===void 0)Jt.setupRenderTarget(C);else if(Et.__hasExternalTextures)Jt.rebindTextures(C,Wt.get(C.texture).__webglTexture,Wt.get(C.depthTexture).__webglTexture);else if(C.depthBuffer){let ie=C.depthTexture;if(Et.__boundDepthTexture!==ie){if(ie!==null&&Wt.has(ie)&&(C.width!==ie.image.width||C.height!==ie.image.height))throw new Error("THREE.WebGLRenderer: Attached DepthTexture is initialized to the incorrect size.");Jt.setupDepthRenderbuffer(C)}}let Dt=C.texture;(Dt.isData3DTexture||Dt.isDataArrayTexture||Dt.isCompressedArrayTexture)&&(At=!0);let Ht=Wt.get(C).__webglFramebuffer;C.isWebGLCubeRenderTarget?(Array.isArray(Ht[X])?J=Ht[X][et]:J=Ht[X],Z=!0):C.samples>0&&Jt.useMultisampledRTT(C)===!1?J=Wt.get(C).__webglMultisampledFramebuffer:Array.isArray(Ht)?J=Ht[et]:J=Ht,tt.copy(C.viewport),ht.copy(C.scissor),st=C.scissorTest}else tt.copy(zt).multiplyScalar(gt).floor(),ht.copy(ge).multiplyScalar(gt).floor(),st=fe;if(et!==0&&(J=k),wt.bindFramebuffer(G.FRAMEBUFFER,J)&&wt.drawBuffers(C,J),wt.viewport(tt),wt.scissor(ht),wt.setScissorTest(st),Z){let Et=Wt.get(C.texture);G.framebufferTexture2D(G.FRAMEBUFFER,G.COLOR_ATTACHMENT0,G.TEXTURE_CUBE_MAP_POSITIVE_X+X,Et.__webglTexture,et)}else if(At){let Et=X;for(let Dt=0;Dt<C.textures.length;Dt++){let Ht=Wt.get(C.textures[Dt]);G.framebufferTextureLayer(G.FRAMEBUFFER,G.COLOR_ATTACHMENT0+Dt,Ht.__webglTexture,et,Et)}}else if(C!==null&&et!==0){let Et=Wt.get(C.texture);G.framebufferTexture2D(G.FRAMEBUFFER,G.COLOR_ATTACHMENT0,G.TEXTURE_2D,Et.__webglTexture,et)}Y=-1};function Ao(C){let X=Wt.get(C);return(X.__readFormat!==C.format||X.__readType!==C.type)&&(X.__readFormat=C.format,X.__readType=C.type,X.__formatReadable=ae.textureFormatReadable(C.format),X.__typeReadable=ae.textureTypeReadable(C.type)),X}this.readRenderTargetPixels=function(C,X,et,J,Z,At,It,Et=0){if(!(C&&C.isWebGLRenderTarget)){te("WebGLRenderer.readRenderTargetPixels: renderTarget is not THREE.WebGLRenderTarget.");return}let Dt=Wt.get(C).__webglFramebuffer;if(C.isWebGLCubeRenderTarget&&It!==void 0&&(Dt=Dt[It],Array.isArray(Dt)&&(Dt=Dt[0])),Dt){wt.bindFramebuffer(G.FRAMEBUFFER,Dt);try{let Ht=C.textures[Et],ie=Ht.format,ye=Ht.type;C.textures.length>1&&G.readBuffer(G.COLOR_ATTACHMENT0+Et);let Gt=Ao(Ht);if(Gt.__formatReadable===!1){te("WebGLRenderer.readRenderTargetPixels: renderTarget is not in RGBA or implementation defined format.");return}if(Gt.__typeReadable===!1){te("WebGLRenderer.readRenderTargetPixels: renderTarget is not in UnsignedByteType or implementation defined type.");return}X>=0&&X<=C.width-J&&et>=0&&et<=C.height-Z&&G.readPixels(X,et,J,Z,xt.convert(ie),xt.convert(ye),At)}finally{let Ht=it!==null?Wt.get(it).__webglFramebuffer:null;wt.bindFramebuffer(G.FRAMEBUFFER,Ht)}}},this.readRenderTargetPixelsAsync=async function(C,X,et,J,Z,At,It,Et=0){if(!(C&&C.isWebGLRenderTarget))throw new Error("THREE.WebGLRenderer.readRenderTargetPixels: renderTarget is not THREE.WebGLRenderTarget.");let Dt=Wt.get(C).__webglFramebuffer;if(C.isWebGLCubeRenderTarget&&It!==void 0&&(Dt=Dt[It],Array.isArray(Dt)&&(Dt=Dt[0])),Dt)if(X>=0&&X<=C.width-J&&et>=0&&et<=C.height-Z){wt.bindFramebuffer(G.FRAMEBUFFER,Dt);let Ht=C.textures[Et],ie=Ht.format,ye=Ht.type;C.textures.length>1&&G.readBuffer(G.COLOR_ATTACHMENT0+Et);let Gt=Ao(Ht);if(Gt.__formatReadable===!1)throw new Error("THREE.WebGLRenderer.readRenderTargetPixelsAsync: renderTarget is not in RGBA or implementation defined format.");if(Gt.__typeReadable===!1)throw new Error("THREE.WebGLRenderer.readRenderTargetPixelsAsync: renderTarget is not in UnsignedByteType or implementation defined type.");let _e=G.createBuffer();G.bindBuffer(G.PIXEL_PACK_BUFFER,_e),G.bufferData(G.PIXEL_PACK_BUFFER,At.byteLength,G.STREAM_READ),G.readPixels(X,et,J,Z,xt.convert(ie),xt.convert(ye),0),G.bindBuffer(G.PIXEL_PACK_BUFFER,null);let en=it!==null?Wt.get(it).__webglFramebuffer:null;wt.bindFramebuffer(G.FRAMEBUFFER,en);let De=G.fenceSync(G.SYNC_GPU_COMMANDS_COMPLETE,0);return G.flush(),await wx(G,De,4),G.bindBuffer(G.PIXEL_PACK_BUFFER,_e),G.getBufferSubData(G.PIXEL_PACK_BUFFER,0,At),G.bindBuffer(G.PIXEL_PACK_BUFFER,null),G.deleteBuffer(_e),G.deleteSync(De),At}else throw new Error("THREE.WebGLRenderer.readRenderTargetPixelsAsync: requested read bounds are out of range.")},this.copyFramebufferToTexture=function(C,X=null,et=0){let J=Math.pow(2,-et),Z=Math.floor(C.image.width*J),At=Math.floor(C.image.height*J),It=X!==null?X.x:0,Et=X!==null?X.y:0;Jt.setTexture2D(C,0),G.copyTexSubImage2D(G.TEXTURE_2D,et,0,0,It,Et,Z,At),wt.unbindTexture()},this.copyTextureToTexture=function(C,X,et=null,J=null,Z=0,At=0){let It,Et,Dt,Ht,ie,ye,Gt,_e,en,De=C.isCompressedTexture?C.mipmaps[At]:C.image;if(et!==null)It=et.max.x-et.min.x,Et=et.max.y-et.min.y,Dt=et.isBox3?et.max.z-et.min.z:1,Ht=et.min.x,ie=et.min.y,ye=et.isBox3?et.min.z:0;else{let pe=Math.pow(2,-Z);It=Math.floor(De.width*pe),Et=Math.floor(De.height*pe),C.isDataArrayTexture?Dt=De.depth:C.isData3DTexture?Dt=Math.floor(De.depth*pe):Dt=1,Ht=0,ie=0,ye=0}J!==null?(Gt=J.x,_e=J.y,en=J.z):(Gt=0,_e=0,en=0);let Oe=xt.convert(X.format),wn=xt.convert(X.type),Bt;X.isData3DTexture?(Jt.setTexture3D(X,0),Bt=G.TEXTURE_3D):X.isDataArrayTexture||X.isCompressedArrayTexture?(Jt.setTexture2DArray(X,0),Bt=G.TEXTURE_2D_ARRAY):(Jt.setTexture2D(X,0),Bt=G.TEXTURE_2D),wt.activeTexture(G.TEXTURE0),wt.pixelStorei(G.UNPACK_FLIP_Y_WEBGL,X.flipY),wt.pixelStorei(G.UNPACK_PREMULTIPLY_ALPHA_WEBGL,X.premultiplyAlpha),wt.pixelStorei(G.UNPACK_ALIGNMENT,X.unpackAlignment);let gn=wt.getParameter(G.UNPACK_ROW_LENGTH),ve=wt.getParameter(G.UNPACK_IMAGE_HEIGHT),Fs=wt.getParameter(G.UNPACK_SKIP_PIXELS),yn=wt.getParameter(G.UNPACK_SKIP_ROWS),Eo=wt.getParameter(G.UNPACK_SKIP_IMAGES);wt.pixelStorei(G.UNPACK_ROW_LENGTH,De.width),wt.pixelStorei(G.UNPACK_IMAGE_HEIGHT,De.height),wt.pixelStorei(G.UNPACK_SKIP_PIXELS,Ht),wt.pixelStorei(G.UNPACK_SKIP_ROWS,ie),wt.pixelStorei(G.UNPACK_SKIP_IMAGES,ye);let ms=C.isDataArrayTexture||C.isData3DTexture,Us=X.isDataArrayTexture||X.isData3DTexture;if(C.isDepthTexture){let pe=Wt.get(C),an=Wt.get(X),ai=Wt.get(pe.__renderTarget),Fe=Wt.get(an.__renderTarget);wt.bindFramebuffer(G.READ_FRAMEBUFFER,ai.__webglFramebuffer),wt.bindFramebuffer(G.DRAW_FRAMEBUFFER,Fe.__webglFramebuffer);for(let _n=0;_n<Dt;_n++)ms&&(G.framebufferTextureLayer(G.READ_FRAMEBUFFER,G.COLOR_ATTACHMENT0,Wt.get(C).__webglTexture,Z,ye+_n),G.framebufferTextureLayer(G.DRAW_FRAMEBUFFER,G.COLOR_ATTACHMENT0,Wt.get(X).__webglTexture,At,en+_n)),G.blitFramebuffer(Ht,ie,Ht+It,ie+Et,Gt,_e,Gt+It,_e+Et,G.DEPTH_BUFFER_BIT,G.NEAREST);wt.bindFramebuffer(G.READ_FRAMEBUFFER,null),wt.bindFramebuffer(G.DRAW_FRAMEBUFFER,null)}else if(Z!==0||C.isRenderTargetTexture||Wt.has(C)){let pe=Wt.get(C),an=Wt.get(X);wt.bindFramebuffer(G.READ_FRAMEBUFFER,N),wt.bindFramebuffer(G.DRAW_FRAMEBUFFER,W);for(let ai=0;ai<Dt;ai++)ms?G.framebufferTextureLayer(G.READ_FRAMEBUFFER,G.COLOR_ATTACHMENT0,pe.__webglTexture,Z,ye+ai):G.framebufferTexture2D(G.READ_FRAMEBUFFER,G.COLOR_ATTACHMENT0,G.TEXTURE_2D,pe.__webglTexture,Z),Us?G.framebufferTextureLayer(G.DRAW_FRAMEBUFFER,G.COLOR_ATTACHMENT0,an.__webglTexture,At,en+ai):G.framebufferTexture2D(G.DRAW_FRAMEBUFFER,G.COLOR_ATTACHMENT0,G.TEXTURE_2D,an.__webglTexture,At),Z!==0?G.blitFramebuffer(Ht,ie,Ht+It,ie+Et,Gt,_e,Gt+It,_e+Et,G.COLOR_BUFFER_BIT,G.NEAREST):Us?G.copyTexSubImage3D(Bt,At,Gt,_e,en+ai,Ht,ie,It,Et):G.copyTexSubImage2D(Bt,At,Gt,_e,Ht,ie,It,Et);wt.bindFramebuffer(G.READ_FRAMEBUFFER,null),wt.bindFramebuffer(G.DRAW_FRAMEBUFFER,null)}else Us?C.isDataTexture||C.isData3DTexture?G.texSubImage3D(Bt,At,Gt,_e,en,It,Et,Dt,Oe,wn,De.data):X.isCompressedArrayTexture?G.compressedTexSubImage3D(Bt,At,Gt,_e,en,It,Et,Dt,Oe,De.data):G.texSubImage3D(Bt,At,Gt,_e,en,It,Et,Dt,Oe,wn,De):C.isDataTexture?G.texSubImage2D(G.TEXTURE_2D,At,Gt,_e,It,Et,Oe,wn,De.data):C.isCompressedTexture?G.compressedTexSubImage2D(G.TEXTURE_2D,At,Gt,_e,De.width,De.height,Oe,De.data):G.texSubImage2D(G.TEXTURE_2D,At,Gt,_e,It,Et,Oe,wn,De);wt.pixelStorei(G.UNPACK_ROW_LENGTH,gn),wt.pixelStorei(G.UNPACK_IMAGE_HEIGHT,ve),wt.pixelStorei(G.UNPACK_SKIP_PIXELS,Fs),wt.pixelStorei(G.UNPACK_SKIP_ROWS,yn),wt.pixelStorei(G.UNPACK_SKIP_IMAGES,Eo),At===0&&X.generateMipmaps===!0&&X.mipmapsAutoUpdate===!0&&G.generateMipmap(Bt),wt.unbindTexture()},this.initRenderTarget=function(C){Wt.get(C).__webglFramebuffer===void 0&&Jt.setupRenderTarget(C)},this.initTexture=function(C){C.isCubeTexture?Jt.setTextureCube(C,0):C.isData3DTexture?Jt.setTexture3D(C,0):C.isDataArrayTexture||C.isCompressedArrayTexture?Jt.setTexture2DArray(C,0):Jt.setTexture2D(C,0),wt.unbindTexture()},this.resetState=function(){z=0,H=0,it=null,wt.reset(),Mt.reset()},typeof __THREE_DEVTOOLS__<"u"&&__THREE_DEVTOOLS__.dispatchEvent(new CustomEvent("observe",{detail:this}))}get coordinateSystem(){return ji}get outputColorSpace(){return this._outputColorSpace}set outputColorSpace(t){this._outputColorSpace=t;let e=this.getContext();e.drawingBufferColorSpace=ue._getDrawingBufferColorSpace(t),e.unpackColorSpace=ue._getUnpackColorSpace()}};Lt.line={worldUnits:{value:1},linewidth:{value:1},resolution:{value:new Xt},dashOffset:{value:0},dashScale:{value:1},dashSize:{value:1},gapSize:{value:1}};_i.line={uniforms:sc.merge([Lt.common,Lt.fog,Lt.line]),vertexShader:`
		#include <common>
		#include <color_pars_vertex>
		#include <fog_pars_vertex>
		#include <logdepthbuf_pars_vertex>
		#include <clipping_planes_pars_vertex>

		uniform float linewidth;
		uniform vec2 resolution;

		attribute vec3 instanceStart;
		attribute vec3 instanceEnd;

		attribute vec3 instanceColorStart;
		attribute vec3 instanceColorEnd;

		#ifdef WORLD_UNITS

			varying vec4 worldPos;
			varying vec3 worldStart;
			varying vec3 worldEnd;

			#ifdef USE_DASH

				varying vec2 vUv;

			#endif

		#else

			varying vec2 vUv;

		#endif

		#ifdef USE_DASH

			uniform float dashScale;
			attribute float instanceDistanceStart;
			attribute float instanceDistanceEnd;
			varying float vLineDistance;

		#endif

		float trimSegmentAlpha( const in vec4 start, const in vec4 end ) {

			// compute the interpolation factor needed to trim the segment so it terminates
			// between the camera plane and the near plane

			// conservative estimate of the near plane
			float a = projectionMatrix[ 2 ][ 2 ]; // 3nd entry in 3th column
			float b = projectionMatrix[ 3 ][ 2 ]; // 3nd entry in 4th column

			// we need different nearEstimate formula for reversed and default depth buffer
			// a is positive with a reversed depth buffer so it can be used for controlling the code flow
			float nearEstimate = ( a > 0.0 ) ? ( - b / ( a + 1.0 ) ) : ( - 0.5 * b / a );

			return ( nearEstimate - start.z ) / ( end.z - start.z );

		}

		void main() {

			#ifdef USE_COLOR

				vColor.xyz = ( position.y < 0.5 ) ? instanceColorStart : instanceColorEnd;

			#endif

			float aspect = resolution.x / resolution.y;

			// camera space
			vec4 start = modelViewMatrix * vec4( instanceStart, 1.0 );
			vec4 end = modelViewMatrix * vec4( instanceEnd, 1.0 );

			#ifdef USE_DASH

				float lineDistanceStart = dashScale * instanceDistanceStart;
				float lineDistanceEnd = dashScale * instanceDistanceEnd;

			#endif

			#ifdef WORLD_UNITS

				worldStart = start.xyz;
				worldEnd = end.xyz;

			#else

				vUv = uv;

			#endif

			// special case for perspective projection, and segments that terminate either in, or behind, the camera plane
			// clearly the gpu firmware has a way of addressing this issue when projecting into ndc space
			// but we need to perform ndc-space calculations in the shader, so we must address this issue directly
			// perhaps there is a more elegant solution -- WestLangley

			bool perspective = ( projectionMatrix[ 2 ][ 3 ] == - 1.0 ); // 4th entry in the 3rd column

			if ( perspective ) {

				if ( start.z < 0.0 && end.z >= 0.0 ) {

					float alpha = trimSegmentAlpha( start, end );
					end.xyz = mix( start.xyz, end.xyz, alpha );

					#ifdef USE_DASH

						lineDistanceEnd = mix( lineDistanceStart, lineDistanceEnd, alpha );

					#endif

				} else if ( end.z < 0.0 && start.z >= 0.0 ) {

					float alpha = trimSegmentAlpha( end, start );
					start.xyz = mix( end.xyz, start.xyz, alpha );

					#ifdef USE_DASH

						lineDistanceStart = mix( lineDistanceEnd, lineDistanceStart, alpha );

					#endif

				}

			}

			#ifdef USE_DASH

				vLineDistance = ( position.y < 0.5 ) ? lineDistanceStart : lineDistanceEnd;
				vUv = uv;

			#endif

			// clip space
			vec4 clipStart = projectionMatrix * start;
			vec4 clipEnd = projectionMatrix * end;

			// ndc space
			vec3 ndcStart = clipStart.xyz / clipStart.w;
			vec3 ndcEnd = clipEnd.xyz / clipEnd.w;

			// direction
			vec2 dir = ndcEnd.xy - ndcStart.xy;

			// account for clip-space aspect ratio
			dir.x *= aspect;
			dir = normalize( dir );

			#ifdef WORLD_UNITS

				vec3 worldDir = normalize( end.xyz - start.xyz );
				vec3 tmpFwd = perspective ? normalize( mix( start.xyz, end.xyz, 0.5 ) ) : vec3( 0.0, 0.0, - 1.0 );
				vec3 worldUp = normalize( cross( worldDir, tmpFwd ) );
				vec3 worldFwd = cross( worldDir, worldUp );
				worldPos = position.y < 0.5 ? start: end;

				// height offset
				float hw = linewidth * 0.5;
				worldPos.xyz += position.x < 0.0 ? hw * worldUp : - hw * worldUp;

				// don't extend the line if we're rendering dashes because we
				// won't be rendering the endcaps
				#ifndef USE_DASH

					// cap extension
					worldPos.xyz += position.y < 0.5 ? - hw * worldDir : hw * worldDir;

					// add width to the box
					worldPos.xyz += worldFwd * hw;

					// endcaps
					if ( position.y > 1.0 || position.y < 0.0 ) {

						worldPos.xyz -= worldFwd * 2.0 * hw;

					}

				#endif

				// project the worldpos
				vec4 clip = projectionMatrix * worldPos;

				// shift the depth of the projected points so the line
				// segments overlap neatly
				vec3 clipPose = ( position.y < 0.5 ) ? ndcStart : ndcEnd;

				// only shift the depth of vertices in front of the camera (#35137)
				if ( clip.w > 0.0 ) clip.z = clipPose.z * clip.w;

			#else

				vec2 offset = vec2( dir.y, - dir.x );
				// undo aspect ratio adjustment
				dir.x /= aspect;
				offset.x /= aspect;

				// sign flip
				if ( position.x < 0.0 ) offset *= - 1.0;

				// endcaps
				if ( position.y < 0.0 ) {

					offset += - dir;

				} else if ( position.y > 1.0 ) {

					offset += dir;

				}

				// adjust for linewidth
				offset *= linewidth;

				// adjust for clip-space to screen-space conversion // maybe resolution should be based on viewport ...
				offset /= resolution.y;

				// select end
				vec4 clip = ( position.y < 0.5 ) ? clipStart : clipEnd;

				// back to clip space
				offset *= clip.w;

				clip.xy += offset;

			#endif

			gl_Position = clip;

			vec4 mvPosition = ( position.y < 0.5 ) ? start : end; // this is an approximation

			#include <logdepthbuf_vertex>
			#include <clipping_planes_vertex>
			#include <fog_vertex>

		}
		`,fragmentShader:`
		uniform vec3 diffuse;
		uniform float opacity;
		uniform float linewidth;

		#ifdef USE_DASH

			uniform float dashOffset;
			uniform float dashSize;
			uniform float gapSize;

		#endif

		varying float vLineDistance;

		#ifdef WORLD_UNITS

			varying vec4 worldPos;
			varying vec3 worldStart;
			varying vec3 worldEnd;

			#ifdef USE_DASH

				varying vec2 vUv;

			#endif

		#else

			varying vec2 vUv;

		#endif

		#include <common>
		#include <color_pars_fragment>
		#include <fog_pars_fragment>
		#include <logdepthbuf_pars_fragment>
		#include <clipping_planes_pars_fragment>

		vec2 closestLineToLine(vec3 p1, vec3 p2, vec3 p3, vec3 p4) {

			float mua;
			float mub;

			vec3 p13 = p1 - p3;
			vec3 p43 = p4 - p3;

			vec3 p21 = p2 - p1;

			float d1343 = dot( p13, p43 );
			float d4321 = dot( p43, p21 );
			float d1321 = dot( p13, p21 );
			float d4343 = dot( p43, p43 );
			float d2121 = dot( p21, p21 );

			float denom = d2121 * d4343 - d4321 * d4321;

			float numer = d1343 * d4321 - d1321 * d4343;

			mua = numer / denom;
			mua = clamp( mua, 0.0, 1.0 );
			mub = ( d1343 + d4321 * ( mua ) ) / d4343;
			mub = clamp( mub, 0.0, 1.0 );

			return vec2( mua, mub );

		}

		void main() {

			float alpha = opacity;
			vec4 diffuseColor = vec4( diffuse, alpha );

			#include <clipping_planes_fragment>

			#ifdef USE_DASH

				if ( vUv.y < - 1.0 || vUv.y > 1.0 ) discard; // discard endcaps

				if ( mod( vLineDistance + dashOffset, dashSize + gapSize ) > dashSize ) discard; // todo - FIX

			#endif

			#ifdef WORLD_UNITS

				float len;

				if ( isOrthographic ) {

					// View rays are parallel to the z axis so the distance reduces to camera-space XY
					vec2 lineDir = worldEnd.xy - worldStart.xy;
					float t = clamp( dot( worldPos.xy - worldStart.xy, lineDir ) / dot( lineDir, lineDir ), 0.0, 1.0 );
					len = length( worldStart.xy + lineDir * t - worldPos.xy );

				} else {

					// Find the closest points on the view ray and the line segment
					vec3 rayEnd = normalize( worldPos.xyz ) * 1e5;
					vec3 lineDir = worldEnd - worldStart;
					vec2 params = closestLineToLine( worldStart, worldEnd, vec3( 0.0, 0.0, 0.0 ), rayEnd );

					vec3 p1 = worldStart + lineDir * params.x;
					vec3 p2 = rayEnd * params.y;
					vec3 delta = p1 - p2;
					len = length( delta );

				}

				float norm = len / linewidth;

				#ifndef USE_DASH

					#ifdef USE_ALPHA_TO_COVERAGE

						float dnorm = fwidth( norm );
						alpha = 1.0 - smoothstep( 0.5 - dnorm, 0.5 + dnorm, norm );

					#else

						if ( norm > 0.5 ) {

							discard;

						}

					#endif

				#endif

			#else

				#ifdef USE_ALPHA_TO_COVERAGE

					// artifacts appear on some hardware if a derivative is taken within a conditional
					float a = vUv.x;
					float b = ( vUv.y > 0.0 ) ? vUv.y - 1.0 : vUv.y + 1.0;
					float len2 = a * a + b * b;
					float dlen = fwidth( len2 );

					if ( abs( vUv.y ) > 1.0 ) {

						alpha = 1.0 - smoothstep( 1.0 - dlen, 1.0 + dlen, len2 );

					}

				#else

					if ( abs( vUv.y ) > 1.0 ) {

						float a = vUv.x;
						float b = ( vUv.y > 0.0 ) ? vUv.y - 1.0 : vUv.y + 1.0;
						float len2 = a * a + b * b;

						if ( len2 > 1.0 ) discard;

					}

				#endif

			#endif

			#include <logdepthbuf_fragment>
			#include <color_fragment>

			gl_FragColor = vec4( diffuseColor.rgb, alpha );

			#include <tonemapping_fragment>
			#include <colorspace_fragment>
			#include <fog_fragment>
			#include <premultiplied_alpha_fragment>

		}
		`};var Nr=class extends vi{constructor(t){super({type:"LineMaterial",uniforms:sc.clone(_i.line.uniforms),vertexShader:_i.line.vertexShader,fragmentShader:_i.line.fragmentShader,clipping:!0}),this.isLineMaterial=!0,this.setValues(t)}get color(){return this.uniforms.diffuse.value}set color(t){this.uniforms.diffuse.value=t}get worldUnits(){return"WORLD_UNITS"in this.defines}set worldUnits(t){t===!0!==this.worldUnits&&(this.needsUpdate=!0),t===!0?this.defines.WORLD_UNITS="":delete this.defines.WORLD_UNITS}get linewidth(){return this.uniforms.linewidth.value}set linewidth(t){this.uniforms.linewidth&&(this.uniforms.linewidth.value=t)}get dashed(){return"USE_DASH"in this.defines}set dashed(t){t===!0!==this.dashed&&(this.needsUpdate=!0),t===!0?this.defines.USE_DASH="":delete this.defines.USE_DASH}get dashScale(){return this.uniforms.dashScale.value}set dashScale(t){this.uniforms.dashScale.value=t}get dashSize(){return this.uniforms.dashSize.value}set dashSize(t){this.uniforms.dashSize.value=t}get dashOffset(){return this.uniforms.dashOffset.value}set dashOffset(t){this.uniforms.dashOffset.value=t}get gapSize(){return this.uniforms.gapSize.value}set gapSize(t){this.uniforms.gapSize.value=t}get opacity(){return this.uniforms.opacity.value}set opacity(t){this.uniforms&&(this.uniforms.opacity.value=t)}get resolution(){return this.uniforms.resolution.value}set resolution(t){this.uniforms.resolution.value.copy(t)}get alphaToCoverage(){return"USE_ALPHA_TO_COVERAGE"in this.defines}set alphaToCoverage(t){this.defines&&(t===!0!==this.alphaToCoverage&&(this.needsUpdate=!0),t===!0?this.defines.USE_ALPHA_TO_COVERAGE="":delete this.defines.USE_ALPHA_TO_COVERAGE)}};var hv=new fn,hd=new F,ar=class extends Xl{constructor(){super(),this.isLineSegmentsGeometry=!0,this.type="LineSegmentsGeometry";let t=[-1,2,0,1,2,0,-1,1,0,1,1,0,-1,0,0,1,0,0,-1,-1,0,1,-1,0],e=[-1,2,1,2,-1,1,1,1,-1,-1,1,-1,-1,-2,1,-2],n=[0,2,1,2,3,1,2,4,3,4,5,3,4,6,5,6,7,5];this.setIndex(n),this.setAttribute("position",new $t(t,3)),this.setAttribute("uv",new $t(e,2))}applyMatrix4(t){let e=this.attributes.instanceStart,n=this.attributes.instanceEnd;return e!==void 0&&(e.applyMatrix4(t),n.applyMatrix4(t),e.needsUpdate=!0),this.boundingBox!==null&&this.computeBoundingBox(),this.boundingSphere!==null&&this.computeBoundingSphere(),this}setPositions(t){let e;t instanceof Float32Array?e=t:Array.isArray(t)&&(e=new Float32Array(t));let n=new Yi(e,6,1);return this.setAttribute("instanceStart",new Wn(n,3,0)),this.setAttribute("instanceEnd",new Wn(n,3,3)),this.instanceCount=this.attributes.instanceStart.count,this.computeBoundingBox(),this.computeBoundingSphere(),this}setColors(t){let e;t instanceof Float32Array?e=t:Array.isArray(t)&&(e=new Float32Array(t));let n=new Yi(e,6,1);return this.setAttribute("instanceColorStart",new Wn(n,3,0)),this.setAttribute("instanceColorEnd",new Wn(n,3,3)),this}fromWireframeGeometry(t){return this.setPositions(t.attributes.position.array),this}fromEdgesGeometry(t){return this.setPositions(t.attributes.position.array),this}fromMesh(t){return this.fromWireframeGeometry(new Ul(t.geometry)),this}fromLineSegments(t){let e=t.geometry;return this.setPositions(e.attributes.position.array),this}computeBoundingBox(){this.boundingBox===null&&(this.boundingBox=new fn);let t=this.attributes.instanceStart,e=this.attributes.instanceEnd;t!==void 0&&e!==void 0&&(this.boundingBox.setFromBufferAttribute(t),hv.setFromBufferAttribute(e),this.boundingBox.union(hv))}computeBoundingSphere(){this.boundingSphere===null&&(this.boundingSphere=new tn),this.boundingBox===null&&this.computeBoundingBox();let t=this.attributes.instanceStart,e=this.attributes.instanceEnd;if(t!==void 0&&e!==void 0){let n=this.boundingSphere.center;this.boundingBox.getCenter(n);let i=0;for(let r=0,o=t.count;r<o;r++)hd.fromBufferAttribute(t,r),i=Math.max(i,n.distanceToSquared(hd)),hd.fromBufferAttribute(e,r),i=Math.max(i,n.distanceToSquared(hd));this.boundingSphere.radius=Math.sqrt(i),isNaN(this.boundingSphere.radius)&&console.error("THREE.LineSegmentsGeometry.computeBoundingSphere(): Computed radius is NaN. The instanced position data is likely to have NaN values.",this)}}toJSON(){}};var Bm=new Se,uv=new F,dv=new F,Yn=new Se,$n=new Se,Ls=new Se,km=new F,zm=new Nt,Jn=new jl,fv=new F,ud=new fn,dd=new tn,Is=new Se,Ns,bo;function pv(s,t,e){return Is.set(0,0,-t,1).applyMatrix4(s.projectionMatrix),Is.multiplyScalar(1/Is.w),Is.x=bo/e.width,Is.y=bo/e.height,Is.applyMatrix4(s.projectionMatrixInverse),Is.multiplyScalar(1/Is.w),Math.abs(Math.max(Is.x,Is.y))}function iP(s,t){let e=s.matrixWorld,n=s.geometry,i=n.attributes.instanceStart,r=n.attributes.instanceEnd,o=Math.min(n.instanceCount,i.count);for(let a=0,l=o;a<l;a++){Jn.start.fromBufferAttribute(i,a),Jn.end.fromBufferAttribute(r,a),Jn.applyMatrix4(e);let c=new F,h=new F;Ns.distanceSqToSegment(Jn.start,Jn.end,h,c),h.distanceTo(c)<bo*.5&&t.push({point:h,pointOnLine:c,distance:Ns.origin.distanceTo(h),object:s,face:null,faceIndex:a,uv:null,uv1:null})}}function sP(s,t,e){let n=t.projectionMatrix,r=s.material.resolution,o=s.matrixWorld,a=s.geometry,l=a.attributes.instanceStart,c=a.attributes.instanceEnd,h=Math.min(a.instanceCount,l.count),u=-t.near;Ns.at(1,Ls),Ls.w=1,Ls.applyMatrix4(t.matrixWorldInverse),Ls.applyMatrix4(n),Ls.multiplyScalar(1/Ls.w),Ls.x*=r.x/2,Ls.y*=r.y/2,Ls.z=0,km.copy(Ls),zm.multiplyMatrices(t.matrixWorldInverse,o);for(let d=0,f=h;d<f;d++){if(Yn.fromBufferAttribute(l,d),$n.fromBufferAttribute(c,d),Yn.w=1,$n.w=1,Yn.applyMatrix4(zm),$n.applyMatrix4(zm),Yn.z>u&&$n.z>u)continue;if(Yn.z>u){let w=Yn.z-$n.z,v=(Yn.z-u)/w;Yn.lerp($n,v)}else if($n.z>u){let w=$n.z-Yn.z,v=($n.z-u)/w;$n.lerp(Yn,v)}Yn.applyMatrix4(n),$n.applyMatrix4(n),Yn.multiplyScalar(1/Yn.w),$n.multiplyScalar(1/$n.w),Yn.x*=r.x/2,Yn.y*=r.y/2,$n.x*=r.x/2,$n.y*=r.y/2,Jn.start.copy(Yn),Jn.start.z=0,Jn.end.copy($n),Jn.end.z=0;let y=Jn.closestPointToPointParameter(km,!0);Jn.at(y,fv);let p=ii.lerp(Yn.z,$n.z,y),g=p>=-1&&p<=1,_=km.distanceTo(fv)<bo*.5;if(g&&_){Jn.start.fromBufferAttribute(l,d),Jn.end.fromBufferAttribute(c,d),Jn.start.applyMatrix4(o),Jn.end.applyMatrix4(o);let w=new F,v=new F;Ns.distanceSqToSegment(Jn.start,Jn.end,v,w),e.push({point:v,pointOnLine:w,distance:Ns.origin.distanceTo(v),object:s,face:null,faceIndex:d,uv:null,uv1:null})}}}var Ia=class extends de{constructor(t=new ar,e=new Nr({color:Math.random()*16777215})){super(t,e),this.isLineSegments2=!0,this.type="LineSegments2"}computeLineDistances(){let t=this.geometry,e=t.attributes.instanceStart,n=t.attributes.instanceEnd,i=new Float32Array(2*e.count);for(let o=0,a=0,l=e.count;o<l;o++,a+=2)uv.fromBufferAttribute(e,o),dv.fromBufferAttribute(n,o),i[a]=a===0?0:i[a-1],i[a+1]=i[a]+uv.distanceTo(dv);let r=new Yi(i,2,1);return t.setAttribute("instanceDistanceStart",new Wn(r,1,0)),t.setAttribute("instanceDistanceEnd",new Wn(r,1,1)),this}raycast(t,e){let n=this.material.worldUnits,i=t.camera;if(i===null&&!n&&console.error('LineSegments2: "Raycaster.camera" needs to be set in order to raycast against LineSegments2 while worldUnits is set to false.'),n===!1&&(this.material.resolution.x===0||this.material.resolution.y===0))return;let r=t.params.Line2!==void 0&&t.params.Line2.threshold||0;Ns=t.ray;let o=this.matrixWorld,a=this.geometry,l=this.material;bo=l.linewidth+r,a.boundingSphere===null&&a.computeBoundingSphere(),dd.copy(a.boundingSphere).applyMatrix4(o);let c;if(n)c=bo*.5;else{let u=Math.max(i.near,dd.distanceToPoint(Ns.origin));c=pv(i,u,l.resolution)}if(dd.radius+=c,Ns.intersectsSphere(dd)===!1)return;a.boundingBox===null&&a.computeBoundingBox(),ud.copy(a.boundingBox).applyMatrix4(o);let h;if(n)h=bo*.5;else{let u=Math.max(i.near,ud.distanceToPoint(Ns.origin));h=pv(i,u,l.resolution)}ud.expandByScalar(h),Ns.intersectsBox(ud)!==!1&&(n?iP(this,e):sP(this,i,e))}onBeforeRender(t){let e=this.material.uniforms;e&&e.resolution&&(t.getViewport(Bm),this.material.uniforms.resolution.value.set(Bm.z,Bm.w))}};var fd=6,lr=class{object;geometry=new ar;positions=new Float32Array(0);colours=new Float32Array(0);count=0;constructor(t,e=1){let n=new Nr({linewidth:t,vertexColors:!0});n.transparent=e<1,n.opacity=e,this.object=new Ia(this.geometry,n),this.object.frustumCulled=!1,this.geometry.boundingSphere=new tn,this.object.raycast=()=>{},this.grow(64)}clear(){this.count=0}add(t,e,n){fd*this.count===this.positions.length&&this.grow(2*this.count);let i=fd*this.count++;t.toArray(this.positions,i),e.toArray(this.positions,i+3),n.toArray(this.colours,i),n.toArray(this.colours,i+3)}commit(){this.geometry.instanceCount=this.count,this.object.visible=this.count>0;for(let t of["instanceStart","instanceColorStart"])this.geometry.getAttribute(t).data.needsUpdate=!0}grow(t){let e=n=>{let i=new Float32Array(fd*t);return i.set(n),i};this.geometry.dispose(),this.positions=this.bind(e(this.positions),"instanceStart","instanceEnd"),this.colours=this.bind(e(this.colours),"instanceColorStart","instanceColorEnd")}bind(t,e,n){let i=new Yi(t,fd,1).setUsage(or);return this.geometry.setAttribute(e,new Wn(i,3,0)),this.geometry.setAttribute(n,new Wn(i,3,3)),t}};var pd=class{object=new Ge;axes=new lr(3);tree=new lr(1.5,.75);colours=[new Rt,new Rt,new Rt];treeColour=new Rt;from=new F;to=new F;constructor(){this.object.add(this.tree.object,this.axes.object)}setPalette(t){t.axes.forEach((e,n)=>this.colours[n].set(e)),this.treeColour.set(t.tree)}draw(t,e){this.axes.clear(),this.tree.clear();for(let{pose:n,parent:i}of t)this.from.setFromMatrixPosition(n),this.colours.forEach((r,o)=>{this.to.setFromMatrixColumn(n,o).multiplyScalar(e).add(this.from),this.axes.add(this.from,this.to,r)}),i!==null&&(this.to.setFromMatrixPosition(i),this.tree.add(this.from,this.to,this.treeColour));this.axes.commit(),this.tree.commit()}};function mv(s,t){return s.map(({name:e,pose:n})=>({text:e,at:new F().setFromMatrixPosition(n),isStrong:e===t}))}var gv={type:"change"},Gm={type:"start"},_v={type:"end"},md=new Ss,yv=new Oi,rP=Math.cos(70*ii.DEG2RAD),Pn=new F,Mi=2*Math.PI,Le={NONE:-1,ROTATE:0,DOLLY:1,PAN:2,TOUCH_ROTATE:3,TOUCH_PAN:4,TOUCH_DOLLY_PAN:5,TOUCH_DOLLY_ROTATE:6},Vm=1e-6,gd=class extends Yl{constructor(t,e=null){super(t,e),this.state=Le.NONE,this.target=new F,this.cursor=new F,this.minDistance=0,this.maxDistance=1/0,this.minZoom=0,this.maxZoom=1/0,this.minTargetRadius=0,this.maxTargetRadius=1/0,this.minPolarAngle=0,this.maxPolarAngle=Math.PI,this.minAzimuthAngle=-1/0,this.maxAzimuthAngle=1/0,this.enableDamping=!1,this.dampingFactor=.05,this.enableZoom=!0,this.zoomSpeed=1,this.enableRotate=!0,this.rotateSpeed=1,this.keyRotateSpeed=1,this.enablePan=!0,this.panSpeed=1,this.screenSpacePanning=!0,this.keyPanSpeed=7,this.zoomToCursor=!1,this.autoRotate=!1,this.autoRotateSpeed=2,this.keys={LEFT:"ArrowLeft",UP:"ArrowUp",RIGHT:"ArrowRight",BOTTOM:"ArrowDown"},this.mouseButtons={LEFT:Pr.ROTATE,MIDDLE:Pr.DOLLY,RIGHT:Pr.PAN},this.touches={ONE:Lr.ROTATE,TWO:Lr.DOLLY_PAN},this.target0=this.target.clone(),this.position0=this.object.position.clone(),this.zoom0=this.object.zoom,this._cursorStyle="auto",this._domElementKeyEvents=null,this._lastPosition=new F,this._lastQuaternion=new We,this._lastTargetPosition=new F,this._quat=new We().setFromUnitVectors(t.up,new F(0,1,0)),this._quatInverse=this._quat.clone().invert(),this._spherical=new Ta,this._sphericalDelta=new Ta,this._scale=1,this._panOffset=new F,this._rotateStart=new Xt,this._rotateEnd=new Xt,this._rotateDelta=new Xt,this._panStart=new Xt,this._panEnd=new Xt,this._panDelta=new Xt,this._dollyStart=new Xt,this._dollyEnd=new Xt,this._dollyDelta=new Xt,this._dollyDirection=new F,this._mouse=new Xt,this._performCursorZoom=!1,this._pointers=[],this._pointerPositions={},this._controlActive=!1,this._onPointerMove=aP.bind(this),this._onPointerDown=oP.bind(this),this._onPointerUp=lP.bind(this),this._onContextMenu=mP.bind(this),this._onMouseWheel=uP.bind(this),this._onKeyDown=dP.bind(this),this._onTouchStart=fP.bind(this),this._onTouchMove=pP.bind(this),this._onMouseDown=cP.bind(this),this._onMouseMove=hP.bind(this),this._interceptControlDown=gP.bind(this),this._interceptControlUp=yP.bind(this),this.domElement!==null&&this.connect(this.domElement),this.update()}set cursorStyle(t){this._cursorStyle=t,t==="grab"?this.domElement.style.cursor="grab":this.domElement.style.cursor="auto"}get cursorStyle(){return this._cursorStyle}connect(t){super.connect(t),this.domElement.addEventListener("pointerdown",this._onPointerDown),this.domElement.addEventListener("pointercancel",this._onPointerUp),this.domElement.addEventListener("contextmenu",this._onContextMenu),this.domElement.addEventListener("wheel",this._onMouseWheel,{passive:!1}),this.domElement.ownerDocument.addEventListener("keydown",this._interceptControlDown,{passive:!0,capture:!0}),this.domElement.style.touchAction="none"}disconnect(){this.state=Le.NONE,this.domElement.removeEventListener("pointerdown",this._onPointerDown),this.domElement.ownerDocument.removeEventListener("pointermove",this._onPointerMove),this.domElement.ownerDocument.removeEventListener("pointerup",this._onPointerUp),this.domElement.removeEventListener("pointercancel",this._onPointerUp),this.domElement.removeEventListener("wheel",this._onMouseWheel),this.domElement.removeEventListener("contextmenu",this._onContextMenu),this.stopListenToKeyEvents(),this.domElement.ownerDocument.removeEventListener("keydown",this._interceptControlDown,{capture:!0}),this.domElement.ownerDocument.removeEventListener("keyup",this._interceptControlUp,{capture:!0}),this._controlActive=!1,this._pointers.length=0,this._pointerPositions={},this.domElement.style.touchAction="",this.domElement.style.cursor="auto"}dispose(){this.disconnect()}getPolarAngle(){return this._spherical.phi}getAzimuthalAngle(){return this._spherical.theta}getDistance(){return this.object.position.distanceTo(this.target)}listenToKeyEvents(t){t.addEventListener("keydown",this._onKeyDown),this._domElementKeyEvents=t}stopListenToKeyEvents(){this._domElementKeyEvents!==null&&(this._domElementKeyEvents.removeEventListener("keydown",this._onKeyDown),this._domElementKeyEvents=null)}saveState(){this.target0.copy(this.target),this.position0.copy(this.object.position),this.zoom0=this.object.zoom}reset(){this.target.copy(this.target0),this.object.position.copy(this.position0),this.object.zoom=this.zoom0,this.object.updateProjectionMatrix(),this.dispatchEvent(gv),this.update(),this.state=Le.NONE}pan(t,e){this._pan(t,e),this.update()}dollyIn(t){this._dollyIn(t),this.update()}dollyOut(t){this._dollyOut(t),this.update()}rotateLeft(t){this._rotateLeft(t),this.update()}rotateUp(t){this._rotateUp(t),this.update()}update(t=null){let e=this.object.position;Pn.copy(e).sub(this.target),Pn.applyQuaternion(this._quat),this._spherical.setFromVector3(Pn),this.autoRotate&&this.state===Le.NONE&&this._rotateLeft(this._getAutoRotationAngle(t)),this.enableDamping?(this._spherical.theta+=this._sphericalDelta.theta*this.dampingFactor,this._spherical.phi+=this._sphericalDelta.phi*this.dampingFactor):(this._spherical.theta+=this._sphericalDelta.theta,this._spherical.phi+=this._sphericalDelta.phi);let n=this.minAzimuthAngle,i=this.maxAzimuthAngle;isFinite(n)&&isFinite(i)&&(n<-Math.PI?n+=Mi:n>Math.PI&&(n-=Mi),i<-Math.PI?i+=Mi:i>Math.PI&&(i-=Mi),n<=i?this._spherical.theta=Math.max(n,Math.min(i,this._spherical.theta)):this._spherical.theta=this._spherical.theta>(n+i)/2?Math.max(n,this._spherical.theta):Math.min(i,this._spherical.theta)),this._spherical.phi=Math.max(this.minPolarAngle,Math.min(this.maxPolarAngle,this._spherical.phi)),this._spherical.makeSafe(),this.enableDamping===!0?this.target.addScaledVector(this._panOffset,this.dampingFactor):this.target.add(this._panOffset),this.target.sub(this.cursor),this.target.clampLength(this.minTargetRadius,this.maxTargetRadius),this.target.add(this.cursor);let r=!1;if(this.zoomToCursor&&this._performCursorZoom||this.object.isOrthographicCamera)this._spherical.radius=this._clampDistance(this._spherical.radius);else{let o=this._spherical.radius;this._spherical.radius=this._clampDistance(this._spherical.radius*this._scale),r=o!=this._spherical.radius}if(Pn.setFromSpherical(this._spherical),Pn.applyQuaternion(this._quatInverse),e.copy(this.target).add(Pn),this.object.lookAt(this.target),this.enableDamping===!0?(this._sphericalDelta.theta*=1-this.dampingFactor,this._sphericalDelta.phi*=1-this.dampingFactor,this._panOffset.multiplyScalar(1-this.dampingFactor)):(this._sphericalDelta.set(0,0,0),this._panOffset.set(0,0,0)),this.zoomToCursor&&this._performCursorZoom){let o=null;if(this.object.isPerspectiveCamera){let a=Pn.length();o=this._clampDistance(a*this._scale);let l=a-o;this.object.position.addScaledVector(this._dollyDirection,l),this.object.updateMatrixWorld(),r=!!l}else if(this.object.isOrthographicCamera){let a=new F(this._mouse.x,this._mouse.y,0);a.unproject(this.object);let l=this.object.zoom;this.object.zoom=Math.max(this.minZoom,Math.min(this.maxZoom,this.object.zoom/this._scale)),this.object.updateProjectionMatrix(),r=l!==this.object.zoom;let c=new F(this._mouse.x,this._mouse.y,0);c.unproject(this.object),this.object.position.sub(c).add(a),this.object.updateMatrixWorld(),o=Pn.length()}else console.warn("WARNING: OrbitControls.js encountered an unknown camera type - zoom to cursor disabled."),this.zoomToCursor=!1;o!==null&&(this.screenSpacePanning?this.target.set(0,0,-1).transformDirection(this.object.matrix).multiplyScalar(o).add(this.object.position):(md.origin.copy(this.object.position),md.direction.set(0,0,-1).transformDirection(this.object.matrix),Math.abs(this.object.up.dot(md.direction))<rP?this.object.lookAt(this.target):(yv.setFromNormalAndCoplanarPoint(this.object.up,this.target),md.intersectPlane(yv,this.target))))}else if(this.object.isOrthographicCamera){let o=this.object.zoom;this.object.zoom=Math.max(this.minZoom,Math.min(this.maxZoom,this.object.zoom/this._scale)),o!==this.object.zoom&&(this.object.updateProjectionMatrix(),r=!0)}return this._scale=1,this._performCursorZoom=!1,r||this._lastPosition.distanceToSquared(this.object.position)>Vm||8*(1-this._lastQuaternion.dot(this.object.quaternion))>Vm||this._lastTargetPosition.distanceToSquared(this.target)>Vm?(this.dispatchEvent(gv),this._lastPosition.copy(this.object.position),this._lastQuaternion.copy(this.object.quaternion),this._lastTargetPosition.copy(this.target),!0):!1}_getAutoRotationAngle(t){return t!==null?Mi/60*this.autoRotateSpeed*t:Mi/60/60*this.autoRotateSpeed}_getZoomScale(t){let e=Math.abs(t*.01);return Math.pow(.95,this.zoomSpeed*e)}_rotateLeft(t){this._sphericalDelta.theta-=t}_rotateUp(t){this._sphericalDelta.phi-=t}_panLeft(t,e){Pn.setFromMatrixColumn(e,0),Pn.multiplyScalar(-t),this._panOffset.add(Pn)}_panUp(t,e){this.screenSpacePanning===!0?Pn.setFromMatrixColumn(e,1):(Pn.setFromMatrixColumn(e,0),Pn.crossVectors(this.object.up,Pn)),Pn.multiplyScalar(t),this._panOffset.add(Pn)}_pan(t,e){let n=this.domElement;if(this.object.isPerspectiveCamera){let i=this.object.position;Pn.copy(i).sub(this.target);let r=Pn.length();r*=Math.tan(this.object.fov/2*Math.PI/180),this._panLeft(2*t*r/n.clientHeight,this.object.matrix),this._panUp(2*e*r/n.clientHeight,this.object.matrix)}else this.object.isOrthographicCamera?(this._panLeft(t*(this.object.right-this.object.left)/this.object.zoom/n.clientWidth,this.object.matrix),this._panUp(e*(this.object.top-this.object.bottom)/this.object.zoom/n.clientHeight,this.object.matrix)):(console.warn("WARNING: OrbitControls.js encountered an unknown camera type - pan disabled."),this.enablePan=!1)}_dollyOut(t){this.object.isPerspectiveCamera||this.object.isOrthographicCamera?this._scale/=t:(console.warn("WARNING: OrbitControls.js encountered an unknown camera type - dolly/zoom disabled."),this.enableZoom=!1)}_dollyIn(t){this.object.isPerspectiveCamera||this.object.isOrthographicCamera?this._scale*=t:(console.warn("WARNING: OrbitControls.js encountered an unknown camera type - dolly/zoom disabled."),this.enableZoom=!1)}_updateZoomParameters(t,e){if(!this.zoomToCursor)return;this._performCursorZoom=!0;let n=this.domElement.getBoundingClientRect(),i=t-n.left,r=e-n.top,o=n.width,a=n.height;this._mouse.x=i/o*2-1,this._mouse.y=-(r/a)*2+1,this._dollyDirection.set(this._mouse.x,this._mouse.y,1).unproject(this.object).sub(this.object.position).normalize()}_clampDistance(t){return Math.max(this.minDistance,Math.min(this.maxDistance,t))}_handleMouseDownRotate(t){this._rotateStart.set(t.clientX,t.clientY)}_handleMouseDownDolly(t){this._updateZoomParameters(t.clientX,t.clientY),this._dollyStart.set(t.clientX,t.clientY)}_handleMouseDownPan(t){this._panStart.set(t.clientX,t.clientY)}_handleMouseMoveRotate(t){this._rotateEnd.set(t.clientX,t.clientY),this._rotateDelta.subVectors(this._rotateEnd,this._rotateStart).multiplyScalar(this.rotateSpeed);let e=this.domElement;this._rotateLeft(Mi*this._rotateDelta.x/e.clientHeight),this._rotateUp(Mi*this._rotateDelta.y/e.clientHeight),this._rotateStart.copy(this._rotateEnd),this.update()}_handleMouseMoveDolly(t){this._dollyEnd.set(t.clientX,t.clientY),this._dollyDelta.subVectors(this._dollyEnd,this._dollyStart),this._dollyDelta.y>0?this._dollyOut(this._getZoomScale(this._dollyDelta.y)):this._dollyDelta.y<0&&this._dollyIn(this._getZoomScale(this._dollyDelta.y)),this._dollyStart.copy(this._dollyEnd),this.zoomToCursor&&(this._performCursorZoom=!0,this._dollyDirection.set(this._mouse.x,this._mouse.y,1).unproject(this.object).sub(this.object.position).normalize()),this.update()}_handleMouseMovePan(t){this._panEnd.set(t.clientX,t.clientY),this._panDelta.subVectors(this._panEnd,this._panStart).multiplyScalar(this.panSpeed),this._pan(this._panDelta.x,this._panDelta.y),this._panStart.copy(this._panEnd),this.update()}_handleMouseWheel(t){this._updateZoomParameters(t.clientX,t.clientY),t.deltaY<0?this._dollyIn(this._getZoomScale(t.deltaY)):t.deltaY>0&&this._dollyOut(this._getZoomScale(t.deltaY)),this.update()}_handleKeyDown(t){let e=!1;switch(t.code){case this.keys.UP:t.ctrlKey||t.metaKey||t.shiftKey?this.enableRotate&&this._rotateUp(Mi*this.keyRotateSpeed/this.domElement.clientHeight):this.enablePan&&this._pan(0,this.keyPanSpeed),e=!0;break;case this.keys.BOTTOM:t.ctrlKey||t.metaKey||t.shiftKey?this.enableRotate&&this._rotateUp(-Mi*this.keyRotateSpeed/this.domElement.clientHeight):this.enablePan&&this._pan(0,-this.keyPanSpeed),e=!0;break;case this.keys.LEFT:t.ctrlKey||t.metaKey||t.shiftKey?this.enableRotate&&this._rotateLeft(Mi*this.keyRotateSpeed/this.domElement.clientHeight):this.enablePan&&this._pan(this.keyPanSpeed,0),e=!0;break;case this.keys.RIGHT:t.ctrlKey||t.metaKey||t.shiftKey?this.enableRotate&&this._rotateLeft(-Mi*this.keyRotateSpeed/this.domElement.clientHeight):this.enablePan&&this._pan(-this.keyPanSpeed,0),e=!0;break}e&&(t.preventDefault(),this.update())}_handleTouchStartRotate(t){if(this._pointers.length===1)this._rotateStart.set(t.pageX,t.pageY);else{let e=this._getSecondPointerPosition(t),n=.5*(t.pageX+e.x),i=.5*(t.pageY+e.y);this._rotateStart.set(n,i)}}_handleTouchStartPan(t){if(this._pointers.length===1)this._panStart.set(t.pageX,t.pageY);else{let e=this._getSecondPointerPosition(t),n=.5*(t.pageX+e.x),i=.5*(t.pageY+e.y);this._panStart.set(n,i)}}_handleTouchStartDolly(t){let e=this._getSecondPointerPosition(t),n=t.pageX-e.x,i=t.pageY-e.y,r=Math.sqrt(n*n+i*i);this._dollyStart.set(0,r)}_handleTouchStartDollyPan(t){this.enableZoom&&this._handleTouchStartDolly(t),this.enablePan&&this._handleTouchStartPan(t)}_handleTouchStartDollyRotate(t){this.enableZoom&&this._handleTouchStartDolly(t),this.enableRotate&&this._handleTouchStartRotate(t)}_handleTouchMoveRotate(t){if(this._pointers.length==1)this._rotateEnd.set(t.pageX,t.pageY);else{let n=this._getSecondPointerPosition(t),i=.5*(t.pageX+n.x),r=.5*(t.pageY+n.y);this._rotateEnd.set(i,r)}this._rotateDelta.subVectors(this._rotateEnd,this._rotateStart).multiplyScalar(this.rotateSpeed);let e=this.domElement;this._rotateLeft(Mi*this._rotateDelta.x/e.clientHeight),this._rotateUp(Mi*this._rotateDelta.y/e.clientHeight),this._rotateStart.copy(this._rotateEnd)}_handleTouchMovePan(t){if(this._pointers.length===1)this._panEnd.set(t.pageX,t.pageY);else{let e=this._getSecondPointerPosition(t),n=.5*(t.pageX+e.x),i=.5*(t.pageY+e.y);this._panEnd.set(n,i)}this._panDelta.subVectors(this._panEnd,this._panStart).multiplyScalar(this.panSpeed),this._pan(this._panDelta.x,this._panDelta.y),this._panStart.copy(this._panEnd)}_handleTouchMoveDolly(t){let e=this._getSecondPointerPosition(t),n=t.pageX-e.x,i=t.pageY-e.y,r=Math.sqrt(n*n+i*i);this._dollyEnd.set(0,r),this._dollyDelta.set(0,Math.pow(this._dollyEnd.y/this._dollyStart.y,this.zoomSpeed)),this._dollyOut(this._dollyDelta.y),this._dollyStart.copy(this._dollyEnd);let o=(t.pageX+e.x)*.5,a=(t.pageY+e.y)*.5;this._updateZoomParameters(o,a)}_handleTouchMoveDollyPan(t){this.enableZoom&&this._handleTouchMoveDolly(t),this.enablePan&&this._handleTouchMovePan(t)}_handleTouchMoveDollyRotate(t){this.enableZoom&&this._handleTouchMoveDolly(t),this.enableRotate&&this._handleTouchMoveRotate(t)}_addPointer(t){this._pointers.push(t.pointerId)}_removePointer(t){delete this._pointerPositions[t.pointerId];for(let e=0;e<this._pointers.length;e++)if(this._pointers[e]==t.pointerId){this._pointers.splice(e,1);return}}_isTrackingPointer(t){for(let e=0;e<this._pointers.length;e++)if(this._pointers[e]==t.pointerId)return!0;return!1}_trackPointer(t){let e=this._pointerPositions[t.pointerId];e===void 0&&(e=new Xt,this._pointerPositions[t.pointerId]=e),e.set(t.pageX,t.pageY)}_getSecondPointerPosition(t){let e=t.pointerId===this._pointers[0]?this._pointers[1]:this._pointers[0];return this._pointerPositions[e]}_customWheelEvent(t){let e=t.deltaMode,n={clientX:t.clientX,clientY:t.clientY,deltaY:t.deltaY};switch(e){case 1:n.deltaY*=16;break;case 2:n.deltaY*=100;break}return t.ctrlKey&&!this._controlActive&&(n.deltaY*=10),n}};function oP(s){this.enabled!==!1&&(this._pointers.length===0&&(this.domElement.setPointerCapture(s.pointerId),this.domElement.ownerDocument.addEventListener("pointermove",this._onPointerMove),this.domElement.ownerDocument.addEventListener("pointerup",this._onPointerUp)),!this._isTrackingPointer(s)&&(this._addPointer(s),s.pointerType==="touch"?this._onTouchStart(s):this._onMouseDown(s),this._cursorStyle==="grab"&&(this.domElement.style.cursor="grabbing")))}function aP(s){this.enabled!==!1&&(s.pointerType==="touch"?this._onTouchMove(s):this._onMouseMove(s))}function lP(s){switch(this._removePointer(s),this._pointers.length){case 0:this.domElement.releasePointerCapture(s.pointerId),this.domElement.ownerDocument.removeEventListener("pointermove",this._onPointerMove),this.domElement.ownerDocument.removeEventListener("pointerup",this._onPointerUp),this.dispatchEvent(_v),this.state=Le.NONE,this._cursorStyle==="grab"&&(this.domElement.style.cursor="grab");break;case 1:let t=this._pointers[0],e=this._pointerPositions[t];this._onTouchStart({pointerId:t,pageX:e.x,pageY:e.y});break}}function cP(s){let t;switch(s.button){case 0:t=this.mouseButtons.LEFT;break;case 1:t=this.mouseButtons.MIDDLE;break;case 2:t=this.mouseButtons.RIGHT;break;default:t=-1}switch(t){case Pr.DOLLY:if(this.enableZoom===!1)return;this._handleMouseDownDolly(s),this.state=Le.DOLLY;break;case Pr.ROTATE:if(s.ctrlKey||s.metaKey||s.shiftKey){if(this.enablePan===!1)return;this._handleMouseDownPan(s),this.state=Le.PAN}else{if(this.enableRotate===!1)return;this._handleMouseDownRotate(s),this.state=Le.ROTATE}break;case Pr.PAN:if(s.ctrlKey||s.metaKey||s.shiftKey){if(this.enableRotate===!1)return;this._handleMouseDownRotate(s),this.state=Le.ROTATE}else{if(this.enablePan===!1)return;this._handleMouseDownPan(s),this.state=Le.PAN}break;default:this.state=Le.NONE}this.state!==Le.NONE&&this.dispatchEvent(Gm)}function hP(s){switch(this.state){case Le.ROTATE:if(this.enableRotate===!1)return;this._handleMouseMoveRotate(s);break;case Le.DOLLY:if(this.enableZoom===!1)return;this._handleMouseMoveDolly(s);break;case Le.PAN:if(this.enablePan===!1)return;this._handleMouseMovePan(s);break}}function uP(s){this.enabled===!1||this.enableZoom===!1||this.state!==Le.NONE||(s.preventDefault(),this.dispatchEvent(Gm),this._handleMouseWheel(this._customWheelEvent(s)),this.dispatchEvent(_v))}function dP(s){this.enabled!==!1&&this._handleKeyDown(s)}function fP(s){switch(this._trackPointer(s),this._pointers.length){case 1:switch(this.touches.ONE){case Lr.ROTATE:if(this.enableRotate===!1){this.state=Le.NONE;break}this._handleTouchStartRotate(s),this.state=Le.TOUCH_ROTATE;break;case Lr.PAN:if(this.enablePan===!1){this.state=Le.NONE;break}this._handleTouchStartPan(s),this.state=Le.TOUCH_PAN;break;default:this.state=Le.NONE}break;case 2:switch(this.touches.TWO){case Lr.DOLLY_PAN:if(this.enableZoom===!1&&this.enablePan===!1)return;this._handleTouchStartDollyPan(s),this.state=Le.TOUCH_DOLLY_PAN;break;case Lr.DOLLY_ROTATE:if(this.enableZoom===!1&&this.enableRotate===!1)return;this._handleTouchStartDollyRotate(s),this.state=Le.TOUCH_DOLLY_ROTATE;break;default:this.state=Le.NONE}break;default:this.state=Le.NONE}this.state!==Le.NONE&&this.dispatchEvent(Gm)}function pP(s){switch(this._trackPointer(s),this.state){case Le.TOUCH_ROTATE:if(this.enableRotate===!1)return;this._handleTouchMoveRotate(s),this.update();break;case Le.TOUCH_PAN:if(this.enablePan===!1)return;this._handleTouchMovePan(s),this.update();break;case Le.TOUCH_DOLLY_PAN:if(this.enableZoom===!1&&this.enablePan===!1)return;this._handleTouchMoveDollyPan(s),this.update();break;case Le.TOUCH_DOLLY_ROTATE:if(this.enableZoom===!1&&this.enableRotate===!1)return;this._handleTouchMoveDollyRotate(s),this.update();break;default:this.state=Le.NONE}}function mP(s){this.enabled!==!1&&s.preventDefault()}function gP(s){s.key==="Control"&&(this._controlActive=!0,this.domElement.ownerDocument.addEventListener("keyup",this._interceptControlUp,{passive:!0,capture:!0}))}function yP(s){s.key==="Control"&&(this._controlActive=!1,this.domElement.ownerDocument.removeEventListener("keyup",this._interceptControlUp,{passive:!0,capture:!0}))}var xv=40,vv=new F(-.78,-.55,.5).normalize(),_P=new F(-1,0,.48).normalize(),Na=new F(0,0,1),xP=1.75,vP=2.4,bP=.35,SP=.1,MP=.45,yd=Math.PI/24,_d=class{constructor(t,e,n){this.changed=e;this.goHome=n;this.camera.up.copy(Na),this.camera.position.copy(vv).multiplyScalar(4),this.controls=new gd(this.camera,t),Object.assign(this.controls,{enableDamping:!0,dampingFactor:.16,minDistance:.15,maxDistance:150,maxPolarAngle:Math.PI*.52,screenSpacePanning:!1,zoomToCursor:!1}),this.controls.addEventListener("change",e),this.controls.addEventListener("start",()=>this.isMoved=!0),t.addEventListener("keydown",this.onKey),this.controls.update()}changed;goHome;camera=new Sn(xv,1,.05,600);controls;isMoved=!1;isFollowing=!1;heading=0;lift=0;get target(){return this.controls.target}get distance(){return this.camera.position.distanceTo(this.target)}resize(t){this.camera.aspect=t;let e=Math.tan(xv*Math.PI/360),n=t<1?e/Math.max(t,.6):e;this.camera.fov=Math.atan(n)*360/Math.PI,this.camera.updateProjectionMatrix()}frame(t,e=xP){let n=new tn(new F,1);t.isEmpty()||t.getBoundingSphere(n);let i=Math.tan(this.camera.fov*Math.PI/360)*Math.min(1,this.camera.aspect),r=e*Math.max(n.radius,bP)/i;this.isMoved=!1,this.target.copy(n.center),this.camera.position.copy(n.center).addScaledVector(vv,r),this.controls.update(),this.changed()}startFollowing(t,e){this.frame(e,vP);let n=this.distance,i=new F().setFromMatrixPosition(t);this.lift=this.target.z-i.z,this.heading=bv(t),this.target.setX(i.x).setY(i.y),this.camera.position.copy(_P).applyAxisAngle(Na,this.heading).multiplyScalar(n).add(this.target),this.isFollowing=!0,this.controls.enablePan=!1,this.controls.update()}stopFollowing(){this.isFollowing=!1,this.controls.enablePan=!0}update(t,e){let n=this.isFollowing&&e!==null&&this.follow(e,t);return this.controls.update(t)||n}follow(t,e){let n=new F().setFromMatrixPosition(t);n.z+=this.lift;let i=n.sub(this.target).multiplyScalar(1-Math.exp(-e/SP)),r=bv(t),o=Sv(r-this.heading)*(1-Math.exp(-e/MP));this.heading=Sv(this.heading+o);let a=this.camera.position.clone().sub(this.target).applyAxisAngle(Na,o);return this.target.add(i),this.camera.position.copy(this.target).add(a),i.lengthSq()>1e-10||Math.abs(o)>1e-5}onKey=t=>{let e=this.camera.position.clone().sub(this.target),n=Math.asin(e.z/e.length()),i=new F().crossVectors(Na,e).normalize();switch((t.shiftKey&&t.key.startsWith("Arrow")?"Shift":"")+t.key){case"ShiftArrowLeft":e.applyAxisAngle(Na,-yd);break;case"ShiftArrowRight":e.applyAxisAngle(Na,yd);break;case"ShiftArrowUp":e.applyAxisAngle(i,-Math.min(yd,1.55-n));break;case"ShiftArrowDown":e.applyAxisAngle(i,Math.min(yd,Math.max(0,n)));break;case"+":case"=":e.multiplyScalar(1/1.15);break;case"-":e.multiplyScalar(1.15);break;case"Home":t.preventDefault(),this.goHome();return;default:return}t.preventDefault(),t.stopPropagation(),this.isMoved=!0,this.camera.position.copy(this.target).add(e),this.controls.update(),this.changed()}};function bv({elements:s}){return Math.atan2(s[1],s[0])}function Sv(s){return Math.atan2(Math.sin(s),Math.cos(s))}var wP=[10,22,40,64,92],Mv=12,wv=220,TP=.8;function Tv(s,t,e,n){let i=[],r=[];for(let o of s){let a=EP(o,s),l=n.get(o.key),c=f=>CP(Hm[f],a)-(f===l?TP:0),h=[...Hm.keys()].sort((f,m)=>c(f)-c(m)),u=Hm.map(f=>AP(o,f)),d=h.find(f=>RP(u[f],t,e)&&!i.some(m=>PP(u[f],m)));d!==void 0&&(n.set(o.key,d),i.push(u[d]),r.push({key:o.key,left:u[d].left,top:u[d].top}))}return r}var Hm=wP.flatMap(s=>Array.from({length:Mv},(t,e)=>{let n=2*Math.PI*e/Mv;return{x:Math.cos(n),y:Math.sin(n),distance:s}}));function AP({x:s,y:t,width:e,height:n},i){let r=s+i.x*(i.distance+e/2)-e/2,o=t+i.y*(i.distance+n/2)-n/2;return{left:r,top:o,right:r+e,bottom:o+n}}function EP(s,t){let e=t.filter(({x:a,y:l})=>Math.hypot(a-s.x,l-s.y)<wv),n=a=>a.reduce((l,c)=>l+c,0)/a.length,i=s.x-n(e.map(a=>a.x)),r=s.y-n(e.map(a=>a.y)),o=Math.max(Math.hypot(i,r),wv/8);return{x:i/o,y:r/o}}function CP(s,t){return s.distance/20-2*(s.x*t.x+s.y*t.y)-.3*s.x}function RP(s,t,e){return s.left>=0&&s.top>=0&&s.right<=t&&s.bottom<=e}function PP(s,t){return s.left<t.right+3&&t.left<s.right+3&&s.top<t.bottom+3&&t.top<s.bottom+3}var LP='500 11.5px system-ui, -apple-system, "Segoe UI", Roboto, sans-serif',cc=18,Av=6,xd=class{constructor(t){this.below=t;this.canvas.setAttribute("aria-hidden","true"),Object.assign(this.canvas.style,{position:"absolute",pointerEvents:"none"}),this.pen=this.canvas.getContext("2d"),t.after(this.canvas)}below;canvas=document.createElement("canvas");pen;widths=new Map;habits=new Map;point=new F;isBlank=!0;resize(t){let{offsetLeft:e,offsetTop:n,clientWidth:i,clientHeight:r}=this.below;this.canvas.width=Math.round(i*t),this.canvas.height=Math.round(r*t),Object.assign(this.canvas.style,{left:`${e}px`,top:`${n}px`,width:`${i}px`,height:`${r}px`}),this.pen?.setTransform(t,0,0,t,0,0),this.isBlank=!0}draw(t,e,n){let{pen:i}=this,{clientWidth:r,clientHeight:o}=this.below;if(i===null||this.isBlank&&t.length===0)return;i.clearRect(0,0,r,o),i.font=LP,i.textBaseline="middle";let a=this.anchorsOf(t,e,r,o),l=new Map(a.map(h=>[h.key,h])),c=new Set(t.filter(h=>h.isStrong).map(({text:h})=>h));for(let{key:h,left:u,top:d}of Tv(a,r,o,this.habits)){let f=l.get(h);i.fillStyle=n.labelBack,i.strokeStyle=n.tree,this.drawLeader(i,f,u,d),i.beginPath(),i.roundRect(u,d,f.width,cc,cc/2),i.fill(),i.fillStyle=c.has(h)?n.labelFixed:n.label,i.fillText(h,u+Av,d+cc/2+.5)}this.isBlank=t.length===0}anchorsOf(t,e,n,i){return t.map(({text:o,at:a,isStrong:l})=>{let{x:c,y:h,z:u}=this.point.copy(a).project(e);return{text:o,isStrong:l,x:(c+1)/2*n,y:(1-h)/2*i,z:u}}).filter(({x:o,y:a,z:l})=>l<1&&o>=0&&o<=n&&a>=0&&a<=i).sort((o,a)=>Number(a.isStrong)-Number(o.isStrong)||o.z-a.z).map(({text:o,x:a,y:l})=>({key:o,x:a,y:l,width:this.widthOf(o),height:cc}))}widthOf(t){let e=this.widths.get(t);return e===void 0&&(e=Math.ceil(this.pen?.measureText(t).width??0)+2*Av,this.widths.set(t,e)),e}drawLeader(t,{x:e,y:n,width:i},r,o){let a=Math.min(Math.max(e,r),r+i),l=Math.min(Math.max(n,o),o+cc);t.globalAlpha=.8,t.lineWidth=1,t.beginPath(),t.moveTo(e,n),t.lineTo(a,l),t.stroke(),t.globalAlpha=1}};var Ev={hardware:2,software:1},IP={hardware:.75,software:.5},NP=50,DP=20,Cv=.85,OP=20,Rv=.85,FP=500,UP=30,vd=class{constructor(t,e,n,i){this.canvas=t;this.step=n;this.resized=i;let r=e?"software":"hardware";this.range={finest:Ev[r],coarsest:IP[r]},this.leastGap=e?UP:0,this.ratio=this.range.finest,this.renderer=new ad({canvas:t,antialias:!e,alpha:!1}),this.renderer.shadowMap.enabled=!0,this.renderer.shadowMap.type=e?$p:mo,this.renderer.autoClear=!1,this.renderer.info.autoReset=!1,t.addEventListener("webglcontextrestored",this.onRestored)}canvas;step;resized;renderer;frames=0;triangles=0;ratio;range;leastGap;request=0;isDirty=!1;last=0;fence=null;cost=0;changedAt=0;dirty=()=>{this.isDirty=!0,this.ask()};resize(){let{clientWidth:t,clientHeight:e}=this.canvas,n=devicePixelRatio||1;this.renderer.setPixelRatio(Math.min(n,this.ratio)),this.renderer.setSize(t,e,!1),this.resized(t,e,Math.min(n,Ev.hardware)),this.dirty()}paint(t,e,n){let{renderer:i}=this;i.info.reset(),i.clear(),i.render(t,n),i.clearDepth(),i.render(e,n),this.triangles=i.info.render.triangles,this.frames++}get gl(){return this.renderer.getContext()}ask(){this.request===0&&(this.request=requestAnimationFrame(this.onFrame))}onRestored=()=>{this.fence=null,this.dirty()};onFrame=t=>{this.request=0,!this.gl.isContextLost()&&(this.isBusy()||this.isDirty&&t-this.last<this.leastGap?this.ask():this.isDirty&&this.draw(t))};draw(t){let e=t-this.last;this.last=t,this.isDirty=!1,this.isDirty=this.step(Math.min(e,100)/1e3)||this.isDirty,this.fence=this.gl.fenceSync(this.gl.SYNC_GPU_COMMANDS_COMPLETE,0),this.gl.flush(),this.ask()}isBusy(){let{fence:t,gl:e}=this;return t===null?!1:e.getSyncParameter(t,e.SYNC_STATUS)===e.UNSIGNALED?!0:(e.deleteSync(t),this.fence=null,this.adapt(performance.now()-this.last),!1)}adapt(t){if(this.cost=Rv*this.cost+(1-Rv)*Math.min(t,FP),this.frames-this.changedAt<OP)return;let{finest:e,coarsest:n}=this.range,i=Math.min(this.ratio,devicePixelRatio||1),r=this.cost>NP?i*Cv:this.cost<DP?i/Cv:i,o=Math.min(Math.max(r,n),e,devicePixelRatio||1);o!==i&&(this.changedAt=this.frames,this.ratio=o,this.resize())}};var BP=5,kP=500,bd=class{constructor(t,e,n,i){this.canvas=t;this.camera=e;this.views=n;this.picked=i;t.addEventListener("pointerdown",r=>this.onDown(r)),t.addEventListener("pointerup",r=>this.onUp(r))}canvas;camera;views;picked;caster=new ql;down=null;onDown(t){let{clientX:e,clientY:n,timeStamp:i,pointerId:r}=t;this.down=t.button===0&&t.isPrimary?{x:e,y:n,time:i,id:r}:null}onUp({clientX:t,clientY:e,timeStamp:n,pointerId:i}){let{down:r}=this;this.down=null,!(r?.id!==i||n-r.time>kP)&&Math.hypot(t-r.x,e-r.y)<=BP&&this.picked(this.at(t,e))}at(t,e){let{left:n,top:i,width:r,height:o}=this.canvas.getBoundingClientRect(),a=(t-n)/r*2-1,l=1-(e-i)/o*2;this.caster.setFromCamera(new Xt(a,l),this.camera);let c=1/0,h=null;for(let[u,d]of this.views()){let[f]=d.object.visible?this.caster.intersectObjects(d.visuals(),!1):[];f!==void 0&&f.distance<c&&(c=f.distance,h={robot:u,link:d.linkOf(f.object)})}return h}};var zP=1e-4;function Pv(s,t){if(s===null||s.layout.id!==t.layout.id)return!0;let e=new Float32Array(s.poses.buffer,16),n=new Float32Array(t.poses.buffer,16);if(e.length!==n.length)return!0;for(let i=0;i<n.length;i++)if(!(Math.abs(n[i]-e[i])<=zP*Math.max(1,Math.abs(e[i])))&&!(Number.isNaN(n[i])&&Number.isNaN(e[i])))return!0;return!1}var Lv=256,VP=.5,GP=.01,HP=.6,WP=.05,Sd=class{object=new Ge;discs=new Cl(new Nl(1,32),new Ui({transparent:!0,opacity:.55,depthWrite:!1}),Lv);arrows=new lr(3);slipColour=new Rt;radii=new WeakMap;constructor(){this.discs.instanceMatrix.setUsage(or),this.discs.frustumCulled=!1,this.discs.raycast=()=>{},this.object.add(this.discs,this.arrows.object),this.begin()}setPalette(t){this.discs.material.color.set(t.contact),this.slipColour.set(t.slip)}forget(t){this.radii.delete(t)}begin(){this.discs.count=0,this.arrows.clear()}add(t,e,n){let i=a=>n.wheels.subarray(4*a,4*(a+1)),r=e.map((a,l)=>i(l)[1]).filter(a=>a>0),o=r.reduce((a,l)=>a+l,0)/Math.max(1,r.length);e.forEach((a,l)=>{let[c,h,u,d]=i(l),f=c>0?this.footingOf(t,a):null;f!==null&&this.discs.count<Lv&&(this.drawDisc(f,h/o),this.drawArrow(f,u,d))})}commit(){this.discs.instanceMatrix.needsUpdate=!0,this.discs.visible=this.discs.count>0,this.arrows.commit()}footingOf(t,e){let n=t.joint(e),i=this.radiusOf(t,e);if(n===void 0||i===0)return null;let{matrixWorld:r}=n,o=n.axis.clone().transformDirection(r),a=new F().setFromMatrixColumn(t.object.matrixWorld,2).normalize();return a.addScaledVector(o,-a.dot(o)),a.lengthSq()<1e-6?null:(a.normalize(),{point:new F().setFromMatrixPosition(r).addScaledVector(a,-i),up:a,sideways:o,forward:o.clone().cross(a),radius:i})}drawDisc({point:t,forward:e,sideways:n,up:i,radius:r},o){let a=.45*r*Math.sqrt(Math.min(o,4)),l=new Nt().makeBasis(e.clone().multiplyScalar(a),n.clone().multiplyScalar(a),i);l.setPosition(t.x,t.y,t.z),this.discs.setMatrixAt(this.discs.count++,l)}drawArrow({point:t,forward:e,sideways:n},i,r){let o=Math.hypot(i,r);if(!(o>GP))return;let a=Math.min(VP*o,HP),l=new F().addScaledVector(e,i).addScaledVector(n,r);l.divideScalar(o);let c=new F().addScaledVector(e,-r).addScaledVector(n,i);c.divideScalar(o);let h=t.clone().addScaledVector(l,a);this.arrows.add(t,h,this.slipColour);let u=Math.min(WP,a/2);for(let d of[-.6*u,.6*u]){let f=h.clone().addScaledVector(l,-u).addScaledVector(c,d);this.arrows.add(h,f,this.slipColour)}}radiusOf(t,e){let n=this.radii.get(t)??new Map;this.radii.set(t,n);let i=n.get(e)??t.wheelRadius(e);return n.set(e,i),i}};var Da=class extends ni{constructor(t){super(t)}load(t,e,n,i){let r=this,o=new Ts(this.manager);o.setPriority(this.priority),o.setCache(this.cache),o.setPath(this.path),o.setResponseType("arraybuffer"),o.setRequestHeader(this.requestHeader),o.setWithCredentials(this.withCredentials),o.load(t,function(a){try{e(r.parse(a))}catch(l){i?i(l):console.error(l),r.manager.itemError(t)}},n,i)}parse(t){function e(c){let h=new DataView(c),u=32/8*3+32/8*3*3+16/8,d=h.getUint32(80,!0);if(80+32/8+d*u===h.byteLength)return!0;let m=[115,111,108,105,100];for(let y=0;y<5;y++)if(n(m,h,y))return!1;return!0}function n(c,h,u){for(let d=0,f=c.length;d<f;d++)if(c[d]!==h.getUint8(u+d))return!1;return!0}function i(c){let h=new DataView(c),u=h.getUint32(80,!0),d,f,m,y=!1,p,g,_,w,v;for(let R=0;R<=70;R++)h.getUint32(R,!1)==1129270351&&h.getUint8(R+4)==82&&h.getUint8(R+5)==61&&(y=!0,p=new Float32Array(u*3*3),g=h.getUint8(R+6)/255,_=h.getUint8(R+7)/255,w=h.getUint8(R+8)/255,v=h.getUint8(R+9)/255);let A=84,S=50,x=new Ae,M=new Float32Array(u*3*3),L=new Float32Array(u*3*3),P=new Rt;for(let R=0;R<u;R++){let O=A+R*S,k=h.getFloat32(O,!0),N=h.getFloat32(O+4,!0),W=h.getFloat32(O+8,!0);if(y){let z=h.getUint16(O+48,!0);(z&32768)===0?(d=(z&31)/31,f=(z>>5&31)/31,m=(z>>10&31)/31):(d=g,f=_,m=w)}for(let z=1;z<=3;z++){let H=O+z*12,it=R*3*3+(z-1)*3;M[it]=h.getFloat32(H,!0),M[it+1]=h.getFloat32(H+4,!0),M[it+2]=h.getFloat32(H+8,!0),L[it]=k,L[it+1]=N,L[it+2]=W,y&&(P.setRGB(d,f,m,Te),p[it]=P.r,p[it+1]=P.g,p[it+2]=P.b)}}return x.setAttribute("position",new hn(M,3)),x.setAttribute("normal",new hn(L,3)),y&&(x.setAttribute("color",new hn(p,3)),x.hasColors=!0,x.alpha=v),x}function r(c){let h=new Ae,u=/solid([\s\S]*?)endsolid/g,d=/facet([\s\S]*?)endfacet/g,f=/solid\s(.+)/,m=0,y=/[\s]+([+-]?(?:\d*)(?:\.\d*)?(?:[eE][+-]?\d+)?)/.source,p=new RegExp("vertex"+y+y+y,"g"),g=new RegExp("normal"+y+y+y,"g"),_=[],w=[],v=[],A=new F,S,x=0,M=0,L=0;for(;(S=u.exec(c))!==null;){M=L;let P=S[0],R=(S=f.exec(P))!==null?S[1]:"";for(v.push(R);(S=d.exec(P))!==null;){let N=0,W=0,z=S[0];for(;(S=g.exec(z))!==null;)A.x=parseFloat(S[1]),A.y=parseFloat(S[2]),A.z=parseFloat(S[3]),W++;for(;(S=p.exec(z))!==null;)_.push(parseFloat(S[1]),parseFloat(S[2]),parseFloat(S[3])),w.push(A.x,A.y,A.z),N++,L++;W!==1&&console.error("THREE.STLLoader: Something isn't right with the normal of face number "+m),N!==3&&console.error("THREE.STLLoader: Something isn't right with the vertices of face number "+m),m++}let O=M,k=L-M;h.userData.groupNames=v,h.addGroup(O,k,x),x++}return h.setAttribute("position",new $t(_,3)),h.setAttribute("normal",new $t(w,3)),h}function o(c){return typeof c!="string"?new TextDecoder().decode(c):c}function a(c){if(typeof c=="string"){let h=new Uint8Array(c.length);for(let u=0;u<c.length;u++)h[u]=c.charCodeAt(u)&255;return h.buffer||h}else return c}let l=a(t);return e(l)?i(l):r(o(t))}};var hc=class extends zl{constructor(t){super(t)}parse(t){function e(z){switch(z.image_type){case d:case y:if(z.colormap_length>256||z.colormap_size!==24||z.colormap_type!==1)throw new Error("THREE.TGALoader: Invalid type colormap data for indexed type.");break;case f:case m:case p:case g:if(z.colormap_type)throw new Error("THREE.TGALoader: Invalid type colormap data for colormap type.");break;case u:throw new Error("THREE.TGALoader: No data.");default:throw new Error("THREE.TGALoader: Invalid type "+z.image_type)}if(z.width<=0||z.height<=0)throw new Error("THREE.TGALoader: Invalid image size.");if(z.pixel_size!==8&&z.pixel_size!==16&&z.pixel_size!==24&&z.pixel_size!==32)throw new Error("THREE.TGALoader: Invalid pixel size "+z.pixel_size)}function n(z,H,it,Y,K){let tt,ht,st=it.pixel_size>>3,j=it.width*it.height*st;if(H&&(ht=K.subarray(Y,Y+=it.colormap_length*(it.colormap_size>>3))),z){tt=new Uint8Array(j);let rt,nt,lt,gt=0,Ut=new Uint8Array(st);for(;gt<j;)if(rt=K[Y++],nt=(rt&127)+1,rt&128){for(lt=0;lt<st;++lt)Ut[lt]=K[Y++];for(lt=0;lt<nt;++lt)tt.set(Ut,gt+lt*st);gt+=st*nt}else{for(nt*=st,lt=0;lt<nt;++lt)tt[gt+lt]=K[Y++];gt+=nt}}else tt=K.subarray(Y,Y+=H?it.width*it.height:j);return{pixel_data:tt,palettes:ht}}function i(z,H,it,Y,K,tt,ht,st,j){let rt=j,nt=P.colormap_index,lt,gt=0,Ut,Kt,zt=P.width;for(Kt=H;Kt!==Y;Kt+=it)for(Ut=K;Ut!==ht;Ut+=tt,gt++)lt=st[gt]-nt,z[(Ut+zt*Kt)*4+3]=255,z[(Ut+zt*Kt)*4+2]=rt[lt*3+0],z[(Ut+zt*Kt)*4+1]=rt[lt*3+1],z[(Ut+zt*Kt)*4+0]=rt[lt*3+2];return z}function r(z,H,it,Y,K,tt,ht,st){let j,rt=0,nt,lt,gt=P.width;for(lt=H;lt!==Y;lt+=it)for(nt=K;nt!==ht;nt+=tt,rt+=2)j=st[rt+0]+(st[rt+1]<<8),z[(nt+gt*lt)*4+0]=(j&31744)>>7,z[(nt+gt*lt)*4+1]=(j&992)>>2,z[(nt+gt*lt)*4+2]=(j&31)<<3,z[(nt+gt*lt)*4+3]=j&32768?0:255;return z}function o(z,H,it,Y,K,tt,ht,st){let j=0,rt,nt,lt=P.width;for(nt=H;nt!==Y;nt+=it)for(rt=K;rt!==ht;rt+=tt,j+=3)z[(rt+lt*nt)*4+3]=255,z[(rt+lt*nt)*4+2]=st[j+0],z[(rt+lt*nt)*4+1]=st[j+1],z[(rt+lt*nt)*4+0]=st[j+2];return z}function a(z,H,it,Y,K,tt,ht,st){let j=0,rt,nt,lt=P.width;for(nt=H;nt!==Y;nt+=it)for(rt=K;rt!==ht;rt+=tt,j+=4)z[(rt+lt*nt)*4+2]=st[j+0],z[(rt+lt*nt)*4+1]=st[j+1],z[(rt+lt*nt)*4+0]=st[j+2],z[(rt+lt*nt)*4+3]=st[j+3];return z}function l(z,H,it,Y,K,tt,ht,st){let j,rt=0,nt,lt,gt=P.width;for(lt=H;lt!==Y;lt+=it)for(nt=K;nt!==ht;nt+=tt,rt++)j=st[rt],z[(nt+gt*lt)*4+0]=j,z[(nt+gt*lt)*4+1]=j,z[(nt+gt*lt)*4+2]=j,z[(nt+gt*lt)*4+3]=255;return z}function c(z,H,it,Y,K,tt,ht,st){let j=0,rt,nt,lt=P.width;for(nt=H;nt!==Y;nt+=it)for(rt=K;rt!==ht;rt+=tt,j+=2)z[(rt+lt*nt)*4+0]=st[j+0],z[(rt+lt*nt)*4+1]=st[j+0],z[(rt+lt*nt)*4+2]=st[j+0],z[(rt+lt*nt)*4+3]=st[j+1];return z}function h(z,H,it,Y,K){let tt,ht,st,j,rt,nt;switch((P.flags&_)>>w){default:case S:tt=0,st=1,rt=H,ht=0,j=1,nt=it;break;case v:tt=0,st=1,rt=H,ht=it-1,j=-1,nt=-1;break;case x:tt=H-1,st=-1,rt=-1,ht=0,j=1,nt=it;break;case A:tt=H-1,st=-1,rt=-1,ht=it-1,j=-1,nt=-1;break}if(k)switch(P.pixel_size){case 8:l(z,ht,j,nt,tt,st,rt,Y);break;case 16:c(z,ht,j,nt,tt,st,rt,Y);break;default:throw new Error("THREE.TGALoader: Format not supported.")}else switch(P.pixel_size){case 8:i(z,ht,j,nt,tt,st,rt,Y,K);break;case 16:r(z,ht,j,nt,tt,st,rt,Y);break;case 24:o(z,ht,j,nt,tt,st,rt,Y);break;case 32:a(z,ht,j,nt,tt,st,rt,Y);break;default:throw new Error("THREE.TGALoader: Format not supported.")}return z}let u=0,d=1,f=2,m=3,y=9,p=10,g=11,_=48,w=4,v=0,A=1,S=2,x=3;if(t.length<19)throw new Error("THREE.TGALoader: Not enough data to contain header.");let M=0,L=new Uint8Array(t),P={id_length:L[M++],colormap_type:L[M++],image_type:L[M++],colormap_index:L[M++]|L[M++]<<8,colormap_length:L[M++]|L[M++]<<8,colormap_size:L[M++],origin:[L[M++]|L[M++]<<8,L[M++]|L[M++]<<8],width:L[M++]|L[M++]<<8,height:L[M++]|L[M++]<<8,pixel_size:L[M++],flags:L[M++]};if(e(P),P.id_length+M>t.length)throw new Error("THREE.TGALoader: No data.");M+=P.id_length;let R=!1,O=!1,k=!1;switch(P.image_type){case y:R=!0,O=!0;break;case d:O=!0;break;case p:R=!0;break;case f:break;case g:R=!0,k=!0;break;case m:k=!0;break}let N=new Uint8Array(P.width*P.height*4),W=n(R,O,P,M,L);return h(N,P.width,P.height,W.pixel_data,W.palettes),{data:N,width:P.width,height:P.height,flipY:!0,generateMipmaps:!0,minFilter:$i}}};function wi(s,t){let e=[],n=s.childNodes;for(let i=0,r=n.length;i<r;i++){let o=n[i];o.nodeName===t&&e.push(o)}return e}function XP(s){return s.length===0?[]:s.trim().split(/\s+/)}function ri(s){return s.length===0?[]:s.trim().split(/\s+/).map(parseFloat)}function Md(s){return s.length===0?[]:s.trim().split(/\s+/).map(t=>parseInt(t))}function zn(s){return s.substring(1)}var wd=class{constructor(){this.count=0}generateId(){return"three_default_"+this.count++}parse(t){if(t.length===0)return null;let e=new DOMParser().parseFromString(t,"application/xml"),n=wi(e,"COLLADA")[0],i=e.getElementsByTagName("parsererror")[0];if(i!==void 0){let l=wi(i,"div")[0],c;return l?c=l.textContent:c=this.parserErrorToText(i),console.error(`THREE.ColladaLoader: Failed to parse collada file.
`,c),null}let r=n.getAttribute("version");console.debug("THREE.ColladaLoader: File version",r);let o=this.parseAsset(wi(n,"asset")[0]),a={animations:{},clips:{},controllers:{},images:{},effects:{},materials:{},cameras:{},lights:{},geometries:{},nodes:{},visualScenes:{},kinematicsModels:{},physicsModels:{},kinematicsScenes:{},joints:{}};return this.library=a,this.collada=n,this.parseLibrary(n,"library_animations","animation",this.parseAnimation.bind(this)),this.parseLibrary(n,"library_animation_clips","animation_clip",this.parseAnimationClip.bind(this)),this.parseLibrary(n,"library_controllers","controller",this.parseController.bind(this)),this.parseLibrary(n,"library_images","image",this.parseImage.bind(this)),this.parseLibrary(n,"library_effects","effect",this.parseEffect.bind(this)),this.parseLibrary(n,"library_materials","material",this.parseMaterial.bind(this)),this.parseLibrary(n,"library_cameras","camera",this.parseCamera.bind(this)),this.parseLibrary(n,"library_lights","light",this.parseLight.bind(this)),this.parseLibrary(n,"library_geometries","geometry",this.parseGeometry.bind(this)),this.parseLibrary(n,"library_nodes","node",this.parseNode.bind(this)),this.parseLibrary(n,"library_visual_scenes","visual_scene",this.parseVisualScene.bind(this)),this.parseLibrary(n,"library_joints","joint",this.parseLibraryJoint.bind(this)),this.parseLibrary(n,"library_kinematics_models","kinematics_model",this.parseKinematicsModel.bind(this)),this.parseLibrary(n,"library_physics_models","physics_model",this.parsePhysicsModel.bind(this)),this.parseLibrary(n,"scene","instance_kinematics_scene",this.parseKinematicsScene.bind(this)),{library:a,asset:o,collada:n}}parserErrorToText(t){let e=[],n=[t];for(;n.length;){let i=n.shift();i.nodeType===Node.TEXT_NODE?e.push(i.textContent):(e.push(`
`),n.push(...i.childNodes))}return e.join("").trim()}parseAsset(t){return{unit:this.parseAssetUnit(wi(t,"unit")[0]),upAxis:this.parseAssetUpAxis(wi(t,"up_axis")[0])}}parseAssetUnit(t){return t!==void 0&&t.hasAttribute("meter")===!0?parseFloat(t.getAttribute("meter")):1}parseAssetUpAxis(t){return t!==void 0?t.textContent:"Y_UP"}parseLibrary(t,e,n,i){let r=wi(t,e)[0];if(r!==void 0){let o=wi(r,n);for(let a=0;a<o.length;a++)i(o[a])}}parseAnimation(t){let e={sources:{},samplers:{},channels:{}},n=!1;for(let i=0,r=t.childNodes.length;i<r;i++){let o=t.childNodes[i];if(o.nodeType!==1)continue;let a;switch(o.nodeName){case"source":a=o.getAttribute("id"),e.sources[a]=this.parseSource(o);break;case"sampler":a=o.getAttribute("id"),e.samplers[a]=this.parseAnimationSampler(o);break;case"channel":a=o.getAttribute("target"),e.channels[a]=this.parseAnimationChannel(o);break;case"animation":this.parseAnimation(o),n=!0;break;default:}}n===!1&&(this.library.animations[t.getAttribute("id")||ii.generateUUID()]=e)}parseAnimationSampler(t){let e={inputs:{}};for(let n=0,i=t.childNodes.length;n<i;n++){let r=t.childNodes[n];if(r.nodeType===1&&r.nodeName==="input"){let o=zn(r.getAttribute("source")),a=r.getAttribute("semantic");e.inputs[a]=o}}return e}parseAnimationChannel(t){let e={},i=t.getAttribute("target").split("/"),r=i.shift(),o=i.shift(),a=o.indexOf("(")!==-1,l=o.indexOf(".")!==-1;if(l)i=o.split("."),o=i.shift(),e.member=i.shift();else if(a){let c=o.split("(");o=c.shift();for(let h=0;h<c.length;h++)c[h]=parseInt(c[h].replace(/\)/,""));e.indices=c}return e.id=r,e.sid=o,e.arraySyntax=a,e.memberSyntax=l,e.sampler=zn(t.getAttribute("source")),e}parseAnimationClip(t){let e={name:t.getAttribute("id")||"default",start:parseFloat(t.getAttribute("start")||0),end:parseFloat(t.getAttribute("end")||0),animations:[]};for(let n=0,i=t.childNodes.length;n<i;n++){let r=t.childNodes[n];r.nodeType===1&&r.nodeName==="instance_animation"&&e.animations.push(zn(r.getAttribute("url")))}this.library.clips[t.getAttribute("id")]=e}parseController(t){let e={};for(let n=0,i=t.childNodes.length;n<i;n++){let r=t.childNodes[n];if(r.nodeType===1)switch(r.nodeName){case"skin":e.id=zn(r.getAttribute("source")),e.skin=this.parseSkin(r);break;case"morph":e.id=zn(r.getAttribute("source")),console.warn("THREE.ColladaLoader: Morph target animation not supported yet.");break}}this.library.controllers[t.getAttribute("id")]=e}parseSkin(t){let e={sources:{}};for(let n=0,i=t.childNodes.length;n<i;n++){let r=t.childNodes[n];if(r.nodeType===1)switch(r.nodeName){case"bind_shape_matrix":e.bindShapeMatrix=ri(r.textContent);break;case"source":let o=r.getAttribute("id");e.sources[o]=this.parseSource(r);break;case"joints":e.joints=this.parseJoints(r);break;case"vertex_weights":e.vertexWeights=this.parseVertexWeights(r);break}}return e}parseJoints(t){let e={inputs:{}};for(let n=0,i=t.childNodes.length;n<i;n++){let r=t.childNodes[n];if(r.nodeType===1&&r.nodeName==="input"){let o=r.getAttribute("semantic"),a=zn(r.getAttribute("source"));e.inputs[o]=a}}return e}parseVertexWeights(t){let e={inputs:{}};for(let n=0,i=t.childNodes.length;n<i;n++){let r=t.childNodes[n];if(r.nodeType===1)switch(r.nodeName){case"input":let o=r.getAttribute("semantic"),a=zn(r.getAttribute("source")),l=parseInt(r.getAttribute("offset"));e.inputs[o]={id:a,offset:l};break;case"vcount":e.vcount=Md(r.textContent);break;case"v":e.v=Md(r.textContent);break}}return e}parseImage(t){let e={init_from:wi(t,"init_from")[0].textContent};this.library.images[t.getAttribute("id")]=e}parseEffect(t){let e={};for(let n=0,i=t.childNodes.length;n<i;n++){let r=t.childNodes[n];r.nodeType===1&&r.nodeName==="profile_COMMON"&&(e.profile=this.parseEffectProfileCOMMON(r))}this.library.effects[t.getAttribute("id")]=e}parseEffectProfileCOMMON(t){let e={surfaces:{},samplers:{}};for(let n=0,i=t.childNodes.length;n<i;n++){let r=t.childNodes[n];if(r.nodeType===1)switch(r.nodeName){case"newparam":this.parseEffectNewparam(r,e);break;case"technique":e.technique=this.parseEffectTechnique(r);break;case"extra":e.extra=this.parseEffectExtra(r);break}}return e}parseEffectNewparam(t,e){let n=t.getAttribute("sid");for(let i=0,r=t.childNodes.length;i<r;i++){let o=t.childNodes[i];if(o.nodeType===1)switch(o.nodeName){case"surface":e.surfaces[n]=this.parseEffectSurface(o);break;case"sampler2D":e.samplers[n]=this.parseEffectSampler(o);break}}}parseEffectSurface(t){let e={};for(let n=0,i=t.childNodes.length;n<i;n++){let r=t.childNodes[n];r.nodeType===1&&r.nodeName==="init_from"&&(e.init_from=r.textContent)}return e}parseEffectSampler(t){let e={};for(let n=0,i=t.childNodes.length;n<i;n++){let r=t.childNodes[n];r.nodeType===1&&r.nodeName==="source"&&(e.source=r.textContent)}return e}parseEffectTechnique(t){let e={};for(let n=0,i=t.childNodes.length;n<i;n++){let r=t.childNodes[n];if(r.nodeType===1)switch(r.nodeName){case"constant":case"lambert":case"blinn":case"phong":e.type=r.nodeName,e.parameters=this.parseEffectParameters(r);break;case"extra":e.extra=this.parseEffectExtra(r);break}}return e}parseEffectParameters(t){let e={};for(let n=0,i=t.childNodes.length;n<i;n++){let r=t.childNodes[n];if(r.nodeType===1)switch(r.nodeName){case"emission":case"diffuse":case"specular":case"bump":case"ambient":case"shininess":case"transparency":e[r.nodeName]=this.parseEffectParameter(r);break;case"transparent":e[r.nodeName]={opaque:r.hasAttribute("opaque")?r.getAttribute("opaque"):"A_ONE",data:this.parseEffectParameter(r)};break}}return e}parseEffectParameter(t){let e={};for(let n=0,i=t.childNodes.length;n<i;n++){let r=t.childNodes[n];if(r.nodeType===1)switch(r.nodeName){case"color":e[r.nodeName]=ri(r.textContent);break;case"float":e[r.nodeName]=parseFloat(r.textContent);break;case"texture":e[r.nodeName]={id:r.getAttribute("texture"),extra:this.parseEffectParameterTexture(r)};break}}return e}parseEffectParameterTexture(t){let e={technique:{}};for(let n=0,i=t.childNodes.length;n<i;n++){let r=t.childNodes[n];r.nodeType===1&&r.nodeName==="extra"&&this.parseEffectParameterTextureExtra(r,e)}return e}parseEffectParameterTextureExtra(t,e){for(let n=0,i=t.childNodes.length;n<i;n++){let r=t.childNodes[n];r.nodeType===1&&r.nodeName==="technique"&&this.parseEffectParameterTextureExtraTechnique(r,e)}}parseEffectParameterTextureExtraTechnique(t,e){for(let n=0,i=t.childNodes.length;n<i;n++){let r=t.childNodes[n];if(r.nodeType===1)switch(r.nodeName){case"repeatU":case"repeatV":case"offsetU":case"offsetV":e.technique[r.nodeName]=parseFloat(r.textContent);break;case"wrapU":case"wrapV":r.textContent.toUpperCase()==="TRUE"?e.technique[r.nodeName]=1:r.textContent.toUpperCase()==="FALSE"?e.technique[r.nodeName]=0:e.technique[r.nodeName]=parseInt(r.textContent);break;case"bump":e[r.nodeName]=this.parseEffectExtraTechniqueBump(r);break}}}parseEffectExtra(t){let e={};for(let n=0,i=t.childNodes.length;n<i;n++){let r=t.childNodes[n];r.nodeType===1&&r.nodeName==="technique"&&(e.technique=this.parseEffectExtraTechnique(r))}return e}parseEffectExtraTechnique(t){let e={};for(let n=0,i=t.childNodes.length;n<i;n++){let r=t.childNodes[n];if(r.nodeType===1)switch(r.nodeName){case"double_sided":e[r.nodeName]=parseInt(r.textContent);break;case"bump":e[r.nodeName]=this.parseEffectExtraTechniqueBump(r);break}}return e}parseEffectExtraTechniqueBump(t){let e={};for(let n=0,i=t.childNodes.length;n<i;n++){let r=t.childNodes[n];r.nodeType===1&&r.nodeName==="texture"&&(e[r.nodeName]={id:r.getAttribute("texture"),texcoord:r.getAttribute("texcoord"),extra:this.parseEffectParameterTexture(r)})}return e}parseMaterial(t){let e={name:t.getAttribute("name")};for(let n=0,i=t.childNodes.length;n<i;n++){let r=t.childNodes[n];r.nodeType===1&&r.nodeName==="instance_effect"&&(e.url=zn(r.getAttribute("url")))}this.library.materials[t.getAttribute("id")]=e}parseCamera(t){let e={name:t.getAttribute("name")};for(let n=0,i=t.childNodes.length;n<i;n++){let r=t.childNodes[n];r.nodeType===1&&r.nodeName==="optics"&&(e.optics=this.parseCameraOptics(r))}this.library.cameras[t.getAttribute("id")]=e}parseCameraOptics(t){for(let e=0;e<t.childNodes.length;e++){let n=t.childNodes[e];if(n.nodeName==="technique_common")return this.parseCameraTechnique(n)}return{}}parseCameraTechnique(t){let e={};for(let n=0;n<t.childNodes.length;n++){let i=t.childNodes[n];switch(i.nodeName){case"perspective":case"orthographic":e.technique=i.nodeName,e.parameters=this.parseCameraParameters(i);break}}return e}parseCameraParameters(t){let e={};for(let n=0;n<t.childNodes.length;n++){let i=t.childNodes[n];switch(i.nodeName){case"xfov":case"yfov":case"xmag":case"ymag":case"znear":case"zfar":case"aspect_ratio":e[i.nodeName]=parseFloat(i.textContent);break}}return e}parseLight(t){let e={};for(let n=0,i=t.childNodes.length;n<i;n++){let r=t.childNodes[n];r.nodeType===1&&r.nodeName==="technique_common"&&(e=this.parseLightTechnique(r))}this.library.lights[t.getAttribute("id")]=e}parseLightTechnique(t){let e={};for(let n=0,i=t.childNodes.length;n<i;n++){let r=t.childNodes[n];if(r.nodeType===1)switch(r.nodeName){case"directional":case"point":case"spot":case"ambient":e.technique=r.nodeName,e.parameters=this.parseLightParameters(r);break}}return e}parseLightParameters(t){let e={};for(let n=0,i=t.childNodes.length;n<i;n++){let r=t.childNodes[n];if(r.nodeType===1)switch(r.nodeName){case"color":let o=ri(r.textContent);e.color=new Rt().fromArray(o),ue.colorSpaceToWorking(e.color,Te);break;case"falloff_angle":e.falloffAngle=parseFloat(r.textContent);break;case"quadratic_attenuation":let a=parseFloat(r.textContent);e.distance=a?Math.sqrt(1/a):0;break}}return e}parseGeometry(t){let e={name:t.getAttribute("name"),sources:{},vertices:{},primitives:[]},n=wi(t,"mesh")[0];if(n!==void 0){for(let i=0;i<n.childNodes.length;i++){let r=n.childNodes[i];if(r.nodeType!==1)continue;let o=r.getAttribute("id");switch(r.nodeName){case"source":e.sources[o]=this.parseSource(r);break;case"vertices":e.vertices=this.parseGeometryVertices(r);break;case"polygons":case"lines":case"linestrips":case"polylist":case"triangles":e.primitives.push(this.parseGeometryPrimitive(r));break;default:}}this.library.geometries[t.getAttribute("id")]=e}}parseSource(t){let e={array:[],stride:3};for(let n=0;n<t.childNodes.length;n++){let i=t.childNodes[n];if(i.nodeType===1)switch(i.nodeName){case"float_array":e.array=ri(i.textContent);break;case"Name_array":e.array=XP(i.textContent);break;case"technique_common":let r=wi(i,"accessor")[0];r!==void 0&&(e.stride=parseInt(r.getAttribute("stride")));break}}return e}parseGeometryVertices(t){let e={};for(let n=0;n<t.childNodes.length;n++){let i=t.childNodes[n];i.nodeType===1&&(e[i.getAttribute("semantic")]=zn(i.getAttribute("source")))}return e}parseGeometryPrimitive(t){let e={type:t.nodeName,material:t.getAttribute("material"),count:parseInt(t.getAttribute("count")),inputs:{},stride:0,hasUV:!1};for(let n=0,i=t.childNodes.length;n<i;n++){let r=t.childNodes[n];if(r.nodeType===1)switch(r.nodeName){case"input":let o=zn(r.getAttribute("source")),a=r.getAttribute("semantic"),l=parseInt(r.getAttribute("offset")),c=parseInt(r.getAttribute("set")),h=c>0?a+c:a;e.inputs[h]={id:o,offset:l},e.stride=Math.max(e.stride,l+1),a==="TEXCOORD"&&(e.hasUV=!0);break;case"vcount":e.vcount=Md(r.textContent);break;case"p":e.p=Md(r.textContent);break}}return e.type==="polygons"&&(e.vcount=[e.p.length/e.stride]),e}parseLibraryJoint(t){this.library.joints[t.getAttribute("id")]=this.parseKinematicsJoint(t)}parseKinematicsModel(t){let e={name:t.getAttribute("name")||"",joints:{},links:[]};for(let n=0;n<t.childNodes.length;n++){let i=t.childNodes[n];i.nodeType===1&&i.nodeName==="technique_common"&&this.parseKinematicsTechniqueCommon(i,e)}this.library.kinematicsModels[t.getAttribute("id")]=e}parseKinematicsTechniqueCommon(t,e){for(let n=0;n<t.childNodes.length;n++){let i=t.childNodes[n];if(i.nodeType===1)switch(i.nodeName){case"joint":e.joints[i.getAttribute("sid")]=this.parseKinematicsJoint(i);break;case"instance_joint":e.joints[i.getAttribute("sid")]=this.library.joints[zn(i.getAttribute("url"))];break;case"link":e.links.push(this.parseKinematicsLink(i));break}}}parseKinematicsJoint(t){let e;for(let n=0;n<t.childNodes.length;n++){let i=t.childNodes[n];if(i.nodeType===1)switch(i.nodeName){case"prismatic":case"revolute":e=this.parseKinematicsJointParameter(i);break}}return e}parseKinematicsJointParameter(t){let e={sid:t.getAttribute("sid"),name:t.getAttribute("name")||"",axis:new F,limits:{min:0,max:0},type:t.nodeName,static:!1,zeroPosition:0,middlePosition:0};for(let n=0;n<t.childNodes.length;n++){let i=t.childNodes[n];if(i.nodeType===1)switch(i.nodeName){case"axis":let r=ri(i.textContent);e.axis.fromArray(r);break;case"limits":let o=i.getElementsByTagName("max")[0],a=i.getElementsByTagName("min")[0];e.limits.max=parseFloat(o.textContent),e.limits.min=parseFloat(a.textContent);break}}return e.limits.min>=e.limits.max&&(e.static=!0),e.middlePosition=(e.limits.min+e.limits.max)/2,e}parseKinematicsLink(t){let e={sid:t.getAttribute("sid"),name:t.getAttribute("name")||"",attachments:[],transforms:[]};for(let n=0;n<t.childNodes.length;n++){let i=t.childNodes[n];if(i.nodeType===1)switch(i.nodeName){case"attachment_full":e.attachments.push(this.parseKinematicsAttachment(i));break;case"matrix":case"translate":case"rotate":e.transforms.push(this.parseKinematicsTransform(i));break}}return e}parseKinematicsAttachment(t){let e={joint:t.getAttribute("joint").split("/").pop(),transforms:[],links:[]};for(let n=0;n<t.childNodes.length;n++){let i=t.childNodes[n];if(i.nodeType===1)switch(i.nodeName){case"link":e.links.push(this.parseKinematicsLink(i));break;case"matrix":case"translate":case"rotate":e.transforms.push(this.parseKinematicsTransform(i));break}}return e}parseKinematicsTransform(t){let e={type:t.nodeName},n=ri(t.textContent);switch(e.type){case"matrix":e.obj=new Nt,e.obj.fromArray(n).transpose();break;case"translate":e.obj=new F,e.obj.fromArray(n);break;case"rotate":e.obj=new F,e.obj.fromArray(n),e.angle=ii.degToRad(n[3]);break}return e}parsePhysicsModel(t){let e={name:t.getAttribute("name")||"",rigidBodies:{}};for(let n=0;n<t.childNodes.length;n++){let i=t.childNodes[n];i.nodeType===1&&i.nodeName==="rigid_body"&&(e.rigidBodies[i.getAttribute("name")]={},this.parsePhysicsRigidBody(i,e.rigidBodies[i.getAttribute("name")]))}this.library.physicsModels[t.getAttribute("id")]=e}parsePhysicsRigidBody(t,e){for(let n=0;n<t.childNodes.length;n++){let i=t.childNodes[n];i.nodeType===1&&i.nodeName==="technique_common"&&this.parsePhysicsTechniqueCommon(i,e)}}parsePhysicsTechniqueCommon(t,e){for(let n=0;n<t.childNodes.length;n++){let i=t.childNodes[n];if(i.nodeType===1)switch(i.nodeName){case"inertia":e.inertia=ri(i.textContent);break;case"mass":e.mass=ri(i.textContent)[0];break}}}parseKinematicsScene(t){let e={bindJointAxis:[]};for(let n=0;n<t.childNodes.length;n++){let i=t.childNodes[n];i.nodeType===1&&i.nodeName==="bind_joint_axis"&&e.bindJointAxis.push(this.parseKinematicsBindJointAxis(i))}this.library.kinematicsScenes[zn(t.getAttribute("url"))]=e}parseKinematicsBindJointAxis(t){let e={target:t.getAttribute("target").split("/").pop()};for(let n=0;n<t.childNodes.length;n++){let i=t.childNodes[n];if(i.nodeType===1&&i.nodeName==="axis"){let r=i.getElementsByTagName("param")[0];e.axis=r.textContent;let o=e.axis.split("inst_").pop().split("axis")[0];e.jointIndex=o.substring(0,o.length-1)}}return e}prepareNodes(t){let e=t.getElementsByTagName("node");for(let n=0;n<e.length;n++){let i=e[n];i.hasAttribute("id")===!1&&i.setAttribute("id",this.generateId())}}parseNode(t){let e=new Nt,n=new F,i={name:t.getAttribute("name")||"",type:t.getAttribute("type"),id:t.getAttribute("id"),sid:t.getAttribute("sid"),matrix:new Nt,nodes:[],instanceCameras:[],instanceControllers:[],instanceLights:[],instanceGeometries:[],instanceNodes:[],transforms:{},transformData:{},transformOrder:[]};for(let r=0;r<t.childNodes.length;r++){let o=t.childNodes[r];if(o.nodeType!==1)continue;let a;switch(o.nodeName){case"node":i.nodes.push(o.getAttribute("id")),this.parseNode(o);break;case"instance_camera":i.instanceCameras.push(zn(o.getAttribute("url")));break;case"instance_controller":i.instanceControllers.push(this.parseNodeInstance(o));break;case"instance_light":i.instanceLights.push(zn(o.getAttribute("url")));break;case"instance_geometry":i.instanceGeometries.push(this.parseNodeInstance(o));break;case"instance_node":i.instanceNodes.push(zn(o.getAttribute("url")));break;case"matrix":a=ri(o.textContent),i.matrix.multiply(e.fromArray(a).transpose());{let l=o.getAttribute("sid");i.transforms[l]=o.nodeName,i.transformData[l]={type:"matrix",array:a},i.transformOrder.push(l)}break;case"translate":a=ri(o.textContent),n.fromArray(a),i.matrix.multiply(e.makeTranslation(n.x,n.y,n.z));{let l=o.getAttribute("sid");i.transforms[l]=o.nodeName,i.transformData[l]={type:"translate",x:a[0],y:a[1],z:a[2]},i.transformOrder.push(l)}break;case"rotate":a=ri(o.textContent);{let l=ii.degToRad(a[3]);i.matrix.multiply(e.makeRotationAxis(n.fromArray(a),l));let c=o.getAttribute("sid");i.transforms[c]=o.nodeName,i.transformData[c]={type:"rotate",axis:[a[0],a[1],a[2]],angle:a[3]},i.transformOrder.push(c)}break;case"scale":a=ri(o.textContent),i.matrix.scale(n.fromArray(a));{let l=o.getAttribute("sid");i.transforms[l]=o.nodeName,i.transformData[l]={type:"scale",x:a[0],y:a[1],z:a[2]},i.transformOrder.push(l)}break;case"extra":break;default:}}return this.hasNode(i.id)?console.warn("THREE.ColladaLoader: There is already a node with ID %s. Exclude current node from further processing.",i.id):this.library.nodes[i.id]=i,i}parseNodeInstance(t){let e={id:zn(t.getAttribute("url")),materials:{},skeletons:[]};for(let n=0;n<t.childNodes.length;n++){let i=t.childNodes[n];switch(i.nodeName){case"bind_material":let r=i.getElementsByTagName("instance_material");for(let o=0;o<r.length;o++){let a=r[o],l=a.getAttribute("symbol"),c=a.getAttribute("target");e.materials[l]=zn(c)}break;case"skeleton":e.skeletons.push(zn(i.textContent));break;default:break}}return e}parseVisualScene(t){let e={name:t.getAttribute("name"),children:[]};this.prepareNodes(t);let n=wi(t,"node");for(let i=0;i<n.length;i++)e.children.push(this.parseNode(n[i]));this.library.visualScenes[t.getAttribute("id")]=e}hasNode(t){return this.library.nodes[t]!==void 0}};var Td=class{constructor(t,e,n,i){this.library=t,this.collada=e,this.textureLoader=n,this.tgaLoader=i,this.tempColor=new Rt,this.animations=[],this.kinematics={},this.position=new F,this.scale=new F,this.quaternion=new We,this.matrix=new Nt,this.deferredPivotAnimations={},this.transformNodes={}}compose(){let t=this.library;this.buildLibrary(t.animations,this.buildAnimation.bind(this)),this.buildLibrary(t.clips,this.buildAnimationClip.bind(this)),this.buildLibrary(t.controllers,this.buildController.bind(this)),this.buildLibrary(t.images,this.buildImage.bind(this)),this.buildLibrary(t.effects,this.buildEffect.bind(this)),this.buildLibrary(t.materials,this.buildMaterial.bind(this)),this.buildLibrary(t.cameras,this.buildCamera.bind(this)),this.buildLibrary(t.lights,this.buildLight.bind(this)),this.buildLibrary(t.geometries,this.buildGeometry.bind(this)),this.buildLibrary(t.visualScenes,this.buildVisualScene.bind(this)),this.setupAnimations(),this.setupKinematics();let e=this.parseScene(wi(this.collada,"scene")[0]);return e.animations=this.animations,{scene:e,animations:this.animations,kinematics:this.kinematics}}buildLibrary(t,e){for(let n in t){let i=t[n];i.build=e(t[n])}}getBuild(t,e){return t.build!==void 0||(t.build=e(t)),t.build}isEmpty(t){return Object.keys(t).length===0}buildAnimation(t){let e=[],n=t.channels,i=t.samplers,r=t.sources,o=this.aggregateAnimationChannels(n,i,r);for(let a in o){let l=this.library.nodes[a];if(!l)continue;let c=o[a];if(this.hasPivotTransforms(l))this.collectDeferredPivotAnimation(a,c);else{let h=this.getNode(a),u=!1;for(let d in c){let f=l.transforms[d],m=l.transformData[d],y=c[d];switch(f){case"matrix":this.buildMatrixTracks(h,y,l,e);break;case"translate":this.buildTranslateTrack(h,y,m,e);break;case"rotate":u||(this.buildRotateTrack(h,d,y,m,l,e),u=!0);break;case"scale":this.buildScaleTrack(h,y,m,e);break}}}}return e}collectDeferredPivotAnimation(t,e){this.deferredPivotAnimations[t]||(this.deferredPivotAnimations[t]={});let n=this.deferredPivotAnimations[t];for(let i in e){n[i]||(n[i]={});for(let r in e[i])n[i][r]=e[i][r]}}hasPivotTransforms(t){let e=["rotatePivot","rotatePivotInverse","rotatePivotTranslation","scalePivot","scalePivotInverse","scalePivotTranslation"];for(let n of e)if(t.transforms[n]!==void 0)return!0;return!1}getAnimation(t){return this.getBuild(this.library.animations[t],this.buildAnimation.bind(this))}aggregateAnimationChannels(t,e,n){let i={};for(let r in t){if(!t.hasOwnProperty(r))continue;let o=t[r],a=e[o.sampler],l=a.inputs.INPUT,c=a.inputs.OUTPUT,h=n[l],u=n[c],d=a.inputs.INTERPOLATION,f=a.inputs.IN_TANGENT,m=a.inputs.OUT_TANGENT,y=d?n[d]:null,p=f?n[f]:null,g=m?n[m]:null,_=o.id,w=o.sid,v=o.member||"default";i[_]||(i[_]={}),i[_][w]||(i[_][w]={}),i[_][w][v]={times:h.array,values:u.array,stride:u.stride,arraySyntax:o.arraySyntax,indices:o.indices,interpolation:y?y.array:null,inTangent:p?p.array:null,outTangent:g?g.array:null,inTangentStride:p?p.stride:0,outTangentStride:g?g.stride:0}}return i}buildMatrixTracks(t,e,n,i){let r=n.matrix.clone().transpose(),o={};for(let c in e){let h=e[c],u=h.times,d=h.values,f=h.stride;for(let m=0,y=u.length;m<y;m++){let p=u[m],g=m*f;if(o[p]===void 0&&(o[p]={}),h.arraySyntax===!0){let _=d[g],w=h.indices[0]+4*h.indices[1];o[p][w]=_}else for(let _=0;_<f;_++)o[p][_]=d[g+_]}}let a=this.prepareAnimationData(o,r),l={name:t.uuid,keyframes:a};this.createKeyframeTracks(l,i)}buildTranslateTrack(t,e,n,i){if(e.default&&e.default.stride===3){let c=e.default,h=Array.from(c.times),u=Array.from(c.values),d=new ei(t.uuid+".position",h,u),f=this.getInterpolationInfo(e);this.applyInterpolation(d,f,e),i.push(d);return}let r=this.getTimesForAllAxes(e);if(r.length===0)return;let o=[],a=this.getInterpolationInfo(e);for(let c=0;c<r.length;c++){let h=r[c],u=this.getValueAtTime(e.X,h,n.x),d=this.getValueAtTime(e.Y,h,n.y),f=this.getValueAtTime(e.Z,h,n.z);o.push(u,d,f)}let l=new ei(t.uuid+".position",r,o);this.applyInterpolation(l,a),i.push(l)}buildRotateTrack(t,e,n,i,r,o){let a=n.ANGLE||n.default;if(!a)return;let l=Array.from(a.times);if(l.length===0)return;let c=[];for(let p of r.transformOrder)if(r.transforms[p]==="rotate"){let _=r.transformData[p];c.push({sid:p,axis:new F(_.axis[0],_.axis[1],_.axis[2]),defaultAngle:_.angle})}let h=new We,u=new We,d=new We,f=[],m=this.getInterpolationInfo(n);for(let p=0;p<l.length;p++){let g=l[p];h.identity();for(let _ of c){let w;_.sid===e?w=this.getValueAtTime(a,g,_.defaultAngle):w=_.defaultAngle;let v=ii.degToRad(w);d.setFromAxisAngle(_.axis,v),h.multiply(d)}p>0&&u.dot(h)<0&&(h.x=-h.x,h.y=-h.y,h.z=-h.z,h.w=-h.w),u.copy(h),f.push(h.x,h.y,h.z,h.w)}let y=new ws(t.uuid+".quaternion",l,f);this.applyInterpolation(y,m),o.push(y)}buildScaleTrack(t,e,n,i){if(e.default&&e.default.stride===3){let c=e.default,h=Array.from(c.times),u=Array.from(c.values),d=new ei(t.uuid+".scale",h,u),f=this.getInterpolationInfo(e);this.applyInterpolation(d,f,e),i.push(d);return}let r=this.getTimesForAllAxes(e);if(r.length===0)return;let o=[],a=this.getInterpolationInfo(e);for(let c=0;c<r.length;c++){let h=r[c],u=this.getValueAtTime(e.X,h,n.x),d=this.getValueAtTime(e.Y,h,n.y),f=this.getValueAtTime(e.Z,h,n.z);o.push(u,d,f)}let l=new ei(t.uuid+".scale",r,o);this.applyInterpolation(l,a),i.push(l)}getTimesForAllAxes(t){let e=[];return t.X&&(e=e.concat(Array.from(t.X.times))),t.Y&&(e=e.concat(Array.from(t.Y.times))),t.Z&&(e=e.concat(Array.from(t.Z.times))),t.ANGLE&&(e=e.concat(Array.from(t.ANGLE.times))),t.default&&(e=e.concat(Array.from(t.default.times))),e=[...new Set(e)].sort((n,i)=>n-i),e}getValueAtTime(t,e,n){if(!t)return n;let i=t.times,r=t.values,o=t.interpolation;for(let a=0;a<i.length;a++){if(i[a]===e)return r[a];if(i[a]>e){if(a===0)return r[0];let l=a-1,c=a,h=i[l],u=i[c],d=r[l],f=r[c],m=o?o[l]:"LINEAR";if(m==="STEP")return d;if(m==="BEZIER"&&t.inTangent&&t.outTangent)return this.evaluateBezierComponent(t,l,c,h,u,e);{let y=(e-h)/(u-h);return d+y*(f-d)}}}return r[r.length-1]}evaluateBezierComponent(t,e,n,i,r,o){let a=t.values,l=t.inTangent,c=t.outTangent,h=t.inTangentStride||1,u=a[e],d=a[n],f,m,y,p;h===2?(f=c[e*2],m=c[e*2+1],y=l[n*2],p=l[n*2+1]):(f=i+(r-i)/3,m=c[e],y=r-(r-i)/3,p=l[n]);let g=(o-i)/(r-i);for(let x=0;x<8;x++){let M=g*g,L=M*g,P=1-g,R=P*P,k=R*P*i+3*R*g*f+3*P*M*y+L*r,N=3*R*(f-i)+6*P*g*(y-f)+3*M*(r-y);if(Math.abs(N)<1e-10)break;let W=k-o;if(Math.abs(W)<1e-10)break;g=g-W/N,g=Math.max(0,Math.min(1,g))}let _=g*g,w=_*g,v=1-g,A=v*v;return A*v*u+3*A*g*m+3*v*_*p+w*d}getInterpolationInfo(t){let e=["X","Y","Z","ANGLE","default"],n=null,i=!0;for(let r of e){let o=t[r];if(!o||!o.interpolation)continue;let a=o.interpolation;for(let l=0;l<a.length;l++){let c=a[l];n===null?n=c:c!==n&&(i=!1)}}return{type:n||"LINEAR",uniform:i}}applyInterpolation(t,e,n=null){if(e.type==="STEP"&&e.uniform)t.setInterpolation(so);else if(e.type==="BEZIER"&&e.uniform&&n){let i=n.default;i&&i.inTangent&&i.outTangent&&(t.setInterpolation(yl),t.settings={inTangents:new Float32Array(i.inTangent),outTangents:new Float32Array(i.outTangent)})}}prepareAnimationData(t,e){let n=[];for(let i in t)n.push({time:parseFloat(i),value:t[i]});n.sort((i,r)=>i.time-r.time);for(let i=0;i<16;i++)this.transformAnimationData(n,i,e.elements[i]);return n}createKeyframeTracks(t,e){let n=t.keyframes,i=t.name,r=[],o=[],a=[],l=[],c=this.position,h=this.quaternion,u=this.scale,d=this.matrix;for(let f=0,m=n.length;f<m;f++){let y=n[f],p=y.time,g=y.value;d.fromArray(g).transpose(),d.decompose(c,h,u),r.push(p),o.push(c.x,c.y,c.z),a.push(h.x,h.y,h.z,h.w),l.push(u.x,u.y,u.z)}return o.length>0&&e.push(new ei(i+".position",r,o)),a.length>0&&e.push(new ws(i+".quaternion",r,a)),l.length>0&&e.push(new ei(i+".scale",r,l)),e}transformAnimationData(t,e,n){let i,r=!0,o,a;for(o=0,a=t.length;o<a;o++)i=t[o],i.value[e]===void 0?i.value[e]=null:r=!1;if(r===!0)for(o=0,a=t.length;o<a;o++)i=t[o],i.value[e]=n;else this.createMissingKeyframes(t,e)}createMissingKeyframes(t,e){let n,i;for(let r=0,o=t.length;r<o;r++){let a=t[r];if(a.value[e]===null){if(n=this.getPrev(t,r,e),i=this.getNext(t,r,e),n===null){a.value[e]=i.value[e];continue}if(i===null){a.value[e]=n.value[e];continue}this.interpolate(a,n,i,e)}}}getPrev(t,e,n){for(;e>=0;){let i=t[e];if(i.value[n]!==null)return i;e--}return null}getNext(t,e,n){for(;e<t.length;){let i=t[e];if(i.value[n]!==null)return i;e++}return null}interpolate(t,e,n,i){if(n.time-e.time===0){t.value[i]=e.value[i];return}t.value[i]=(t.time-e.time)*(n.value[i]-e.value[i])/(n.time-e.time)+e.value[i]}buildAnimationClip(t){let e=[],n=t.name,i=t.end-t.start||-1,r=t.animations;for(let o=0,a=r.length;o<a;o++){let l=this.getAnimation(r[o]);for(let c=0,h=l.length;c<h;c++)e.push(l[c])}return new ba(n,i,e)}getAnimationClip(t){return this.getBuild(this.library.clips[t],this.buildAnimationClip.bind(this))}buildController(t){let e={id:t.id},n=this.library.geometries[e.id];return t.skin!==void 0&&(e.skin=this.buildSkin(t.skin),n.sources.skinIndices=e.skin.indices,n.sources.skinWeights=e.skin.weights),e}buildSkin(t){let n={joints:[],indices:{array:[],stride:4},weights:{array:[],stride:4}},i=t.sources,r=t.vertexWeights,o=r.vcount,a=r.v,l=r.inputs.JOINT.offset,c=r.inputs.WEIGHT.offset,h=t.sources[t.joints.inputs.JOINT],u=t.sources[t.joints.inputs.INV_BIND_MATRIX],d=i[r.inputs.WEIGHT.id].array,f=0,m,y,p;for(m=0,p=o.length;m<p;m++){let _=o[m],w=[];for(y=0;y<_;y++){let v=a[f+l],A=a[f+c],S=d[A];w.push({index:v,weight:S}),f+=2}for(w.sort(g),y=0;y<4;y++){let v=w[y];v!==void 0?(n.indices.array.push(v.index),n.weights.array.push(v.weight)):(n.indices.array.push(0),n.weights.array.push(0))}}for(t.bindShapeMatrix?n.bindMatrix=new Nt().fromArray(t.bindShapeMatrix).transpose():n.bindMatrix=new Nt().identity(),m=0,p=h.array.length;m<p;m++){let _=h.array[m],w=new Nt().fromArray(u.array,m*u.stride).transpose();n.joints.push({name:_,boneInverse:w})}return n;function g(_,w){return w.weight-_.weight}}getController(t){return this.getBuild(this.library.controllers[t],this.buildController.bind(this))}buildImage(t){return t.build!==void 0?t.build:t.init_from}getImage(t){let e=this.library.images[t];return e!==void 0?this.getBuild(e,this.buildImage.bind(this)):(console.warn("THREE.ColladaLoader: Couldn't find image with ID:",t),null)}buildEffect(t){return t}getEffect(t){return this.getBuild(this.library.effects[t],this.buildEffect.bind(this))}getTextureLoader(t){let e,n=t.slice((t.lastIndexOf(".")-1>>>0)+2);return n=n.toLowerCase(),n==="tga"?e=this.tgaLoader:e=this.textureLoader,e}buildMaterial(t){let e=this.getEffect(t.url),n=e.profile.technique,i;switch(n.type){case"phong":case"blinn":i=new qn;break;case"lambert":i=new lo;break;default:i=new Ui;break}i.name=t.name||"";let r=this;function o(h,u=null){let d=e.profile.samplers[h.id],f=null;if(d!==void 0){let m=e.profile.surfaces[d.source];f=r.getImage(m.init_from)}else console.warn("THREE.ColladaLoader: Undefined sampler. Access image directly (see #12530)."),f=r.getImage(h.id);if(f!==null){let m=r.getTextureLoader(f);if(m!==void 0){let y=m.load(f),p=h.extra;if(p!==void 0&&p.technique!==void 0&&r.isEmpty(p.technique)===!1){let g=p.technique;y.wrapS=g.wrapU?Js:pi,y.wrapT=g.wrapV?Js:pi,y.offset.set(g.offsetU||0,g.offsetV||0),y.repeat.set(g.repeatU||1,g.repeatV||1)}else y.wrapS=Js,y.wrapT=Js;return u!==null&&(y.colorSpace=u),y}else return console.warn("THREE.ColladaLoader: Loader for texture %s not found.",f),null}else return console.warn("THREE.ColladaLoader: Couldn't create texture with ID:",h.id),null}let a=n.parameters;for(let h in a){let u=a[h];switch(h){case"diffuse":u.color&&i.color.fromArray(u.color),u.texture&&(i.map=o(u.texture,Te));break;case"specular":u.color&&i.specular&&i.specular.fromArray(u.color),u.texture&&(i.specularMap=o(u.texture));break;case"bump":u.texture&&(i.normalMap=o(u.texture));break;case"ambient":u.texture&&(i.lightMap=o(u.texture,Te));break;case"shininess":u.float&&i.shininess&&(i.shininess=u.float);break;case"emission":u.color&&i.emissive&&i.emissive.fromArray(u.color),u.texture&&(i.emissiveMap=o(u.texture,Te));break}}ue.colorSpaceToWorking(i.color,Te),i.specular&&ue.colorSpaceToWorking(i.specular,Te),i.emissive&&ue.colorSpaceToWorking(i.emissive,Te);let l=a.transparent,c=a.transparency;if(c===void 0&&l&&(c={float:1}),l===void 0&&c&&(l={opaque:"A_ONE",data:{color:[1,1,1,1]}}),l&&c)if(l.data.texture)i.transparent=!0;else{let h=l.data.color;switch(l.opaque){case"A_ONE":i.opacity=h[3]*c.float;break;case"RGB_ZERO":i.opacity=1-h[0]*c.float;break;case"A_ZERO":i.opacity=1-h[3]*c.float;break;case"RGB_ONE":i.opacity=h[0]*c.float;break;default:console.warn('THREE.ColladaLoader: Invalid opaque type "%s" of transparent tag.',l.opaque)}i.opacity<1&&(i.transparent=!0)}if(n.extra!==void 0&&n.extra.technique!==void 0){let h=n.extra.technique;for(let u in h){let d=h[u];switch(u){case"double_sided":i.side=d===1?yi:Es;break;case"bump":i.normalMap=o(d.texture),i.normalScale=new Xt(1,1);break}}}return i}getMaterial(t){return this.getBuild(this.library.materials[t],this.buildMaterial.bind(this))}buildCamera(t){let e;switch(t.optics.technique){case"perspective":e=new Sn(t.optics.parameters.yfov,t.optics.parameters.aspect_ratio,t.optics.parameters.znear,t.optics.parameters.zfar);break;case"orthographic":let n=t.optics.parameters.ymag,i=t.optics.parameters.xmag,r=t.optics.parameters.aspect_ratio;i=i===void 0?n*r:i,n=n===void 0?i/r:n,i*=.5,n*=.5,e=new uo(-i,i,n,-n,t.optics.parameters.znear,t.optics.parameters.zfar);break;default:e=new Sn;break}return e.name=t.name||"",e}getCamera(t){let e=this.library.cameras[t];return e!==void 0?this.getBuild(e,this.buildCamera.bind(this)):(console.warn("THREE.ColladaLoader: Couldn't find camera with ID:",t),null)}buildLight(t){let e;switch(t.technique){case"directional":e=new fo;break;case"point":e=new Hl;break;case"spot":e=new Gl;break;case"ambient":e=new Wl;break}return t.parameters.color&&e.color.copy(t.parameters.color),t.parameters.distance&&(e.distance=t.parameters.distance),t.parameters.falloffAngle&&(e.angle=ii.degToRad(t.parameters.falloffAngle)),e}getLight(t){let e=this.library.lights[t];return e!==void 0?this.getBuild(e,this.buildLight.bind(this)):(console.warn("THREE.ColladaLoader: Couldn't find light with ID:",t),null)}groupPrimitives(t){let e={};for(let n=0;n<t.length;n++){let i=t[n];e[i.type]===void 0&&(e[i.type]=[]),e[i.type].push(i)}return e}checkUVCoordinates(t){let e=0;for(let n=0,i=t.length;n<i;n++)t[n].hasUV===!0&&e++;e>0&&e<t.length&&(t.uvsNeedsFix=!0)}buildGeometry(t){let e={},n=t.sources,i=t.vertices,r=t.primitives;if(r.length===0)return{};let o=this.groupPrimitives(r);for(let a in o){let l=o[a];this.checkUVCoordinates(l),e[a]=this.buildGeometryType(l,n,i)}return e}buildGeometryType(t,e,n){let i={},r={array:[],stride:0},o={array:[],stride:0},a={array:[],stride:0},l={array:[],stride:0},c={array:[],stride:0},h={array:[],stride:4},u={array:[],stride:4},d=new Ae,f=[],m=0;for(let y=0;y<t.length;y++){let p=t[y],g=p.inputs,_=0;switch(p.type){case"lines":case"linestrips":_=p.count*2;break;case"triangles":_=p.count*3;break;case"polygons":case"polylist":for(let w=0;w<p.count;w++){let v=p.vcount[w];switch(v){case 3:_+=3;break;case 4:_+=6;break;default:_+=(v-2)*3;break}}break;default:console.warn("THREE.ColladaLoader: Unknown primitive type:",p.type)}d.addGroup(m,_,y),m+=_,p.material&&f.push(p.material),p.positionSource=e[n.POSITION],p.positionOffset=g.VERTEX.offset;for(let w in g){let v=g[w];switch(w){case"VERTEX":for(let A in n){let S=n[A];switch(A){case"POSITION":let x=r.array.length;if(this.buildGeometryData(p,e[S],v.offset,r.array),r.stride=e[S].stride,e.skinWeights&&e.skinIndices&&(this.buildGeometryData(p,e.skinIndices,v.offset,h.array),this.buildGeometryData(p,e.skinWeights,v.offset,u.array)),p.hasUV===!1&&t.uvsNeedsFix===!0){let M=(r.array.length-x)/r.stride;for(let L=0;L<M;L++)a.array.push(0,0)}break;case"NORMAL":this.buildGeometryData(p,e[S],v.offset,o.array),o.stride=e[S].stride;break;case"COLOR":this.buildGeometryData(p,e[S],v.offset,c.array,!0),c.stride=e[S].stride;break;case"TEXCOORD":this.buildGeometryData(p,e[S],v.offset,a.array),a.stride=e[S].stride;break;case"TEXCOORD1":this.buildGeometryData(p,e[S],v.offset,l.array),a.stride=e[S].stride;break;default:console.warn('THREE.ColladaLoader: Semantic "%s" not handled in geometry build process.',A)}}break;case"NORMAL":this.buildGeometryData(p,e[v.id],v.offset,o.array),o.stride=e[v.id].stride;break;case"COLOR":this.buildGeometryData(p,e[v.id],v.offset,c.array,!0),c.stride=e[v.id].stride;break;case"TEXCOORD":this.buildGeometryData(p,e[v.id],v.offset,a.array),a.stride=e[v.id].stride;break;case"TEXCOORD1":this.buildGeometryData(p,e[v.id],v.offset,l.array),l.stride=e[v.id].stride;break}}}return r.array.length>0&&d.setAttribute("position",new $t(r.array,r.stride)),o.array.length>0&&d.setAttribute("normal",new $t(o.array,o.stride)),c.array.length>0&&d.setAttribute("color",new $t(c.array,c.stride)),a.array.length>0&&d.setAttribute("uv",new $t(a.array,a.stride)),l.array.length>0&&d.setAttribute("uv1",new $t(l.array,l.stride)),h.array.length>0&&d.setAttribute("skinIndex",new $t(h.array,h.stride)),u.array.length>0&&d.setAttribute("skinWeight",new $t(u.array,u.stride)),i.data=d,i.type=t[0].type,i.materialKeys=f,i}buildGeometryData(t,e,n,i,r=!1){let o=t.p,a=t.stride,l=t.vcount,c=t.positionSource,h=t.positionOffset,u=this.tempColor;function d(y){let p=o[y+n]*m,g=p+m;for(;p<g;p++)i.push(f[p]);if(r){let _=i.length-m;u.setRGB(i[_+0],i[_+1],i[_+2],Te),i[_+0]=u.r,i[_+1]=u.g,i[_+2]=u.b}}let f=e.array,m=e.stride;if(t.vcount!==void 0){let y=0;for(let p=0,g=l.length;p<g;p++){let _=l[p];if(_===4){let w=y+a*0,v=y+a*1,A=y+a*2,S=y+a*3;d(w),d(v),d(S),d(v),d(A),d(S)}else if(_===3){let w=y+a*0,v=y+a*1,A=y+a*2;d(w),d(v),d(A)}else if(_>4){let w=[];for(let L=0;L<_;L++){let P=y+a*L+h,R=o[P]*c.stride,O=c.array[R],k=c.array[R+1],N=c.array[R+2];w.push(new F(O,k,N))}let v=new F,A=new as;A.a=w[0],A.b=w[1],A.c=w[2],A.getNormal(v);let S=[];if(Math.abs(v.x)>Math.abs(v.y)&&Math.abs(v.x)>Math.abs(v.z))for(let L=0;L<_;L++)S.push(new Xt(w[L].y,w[L].z));else if(Math.abs(v.y)>Math.abs(v.z))for(let L=0;L<_;L++)S.push(new Xt(w[L].x,w[L].z));else for(let L=0;L<_;L++)S.push(new Xt(w[L].x,w[L].y));let x=xa.isClockWise(S);x===!0&&S.reverse();let M=xa.triangulateShape(S,[]);for(let L=0;L<M.length;L++){let P=M[L],R,O,k;x===!1?(R=P[0],O=P[1],k=P[2]):(R=_-1-P[0],O=_-1-P[2],k=_-1-P[1]);let N=y+a*R,W=y+a*O,z=y+a*k;d(N),d(W),d(z)}}y+=a*_}}else for(let y=0,p=o.length;y<p;y+=a)d(y)}getGeometry(t){return this.getBuild(this.library.geometries[t],this.buildGeometry.bind(this))}buildKinematicsModel(t){return t.build!==void 0?t.build:t}getKinematicsModel(t){return this.getBuild(this.library.kinematicsModels[t],this.buildKinematicsModel.bind(this))}buildKinematicsScene(t){return t.build!==void 0?t.build:t}getKinematicsScene(t){return this.getBuild(this.library.kinematicsScenes[t],this.buildKinematicsScene.bind(this))}setupKinematics(){let t=Object.keys(this.library.kinematicsModels)[0],e=Object.keys(this.library.kinematicsScenes)[0],n=Object.keys(this.library.visualScenes)[0];if(t===void 0||e===void 0)return;let i=this.getKinematicsModel(t),r=this.getKinematicsScene(e),o=this.getVisualScene(n),a=r.bindJointAxis,l={},c=this.collada,h=this;for(let m=0,y=a.length;m<y;m++){let p=a[m],g=c.querySelector('[sid="'+p.target+'"]');if(g){let _=g.parentElement;u(p.jointIndex,_)}}function u(m,y){let p=y.getAttribute("name"),g=i.joints[m],_=h.buildTransformList(y);o.traverse(function(w){w.name===p&&(l[m]={object:w,transforms:_,joint:g,position:g.zeroPosition})})}let d=new Nt,f=this.matrix;this.kinematics={joints:i&&i.joints,getJointValue:function(m){let y=l[m];if(y)return y.position;console.warn("THREE.ColladaLoader: Joint "+m+" doesn't exist.")},setJointValue:function(m,y){let p=l[m];if(p){let g=p.joint;if(y>g.limits.max||y<g.limits.min)console.warn("THREE.ColladaLoader: Joint "+m+" value "+y+" outside of limits (min: "+g.limits.min+", max: "+g.limits.max+").");else if(g.static)console.warn("THREE.ColladaLoader: Joint "+m+" is static.");else{let _=p.object,w=g.axis,v=p.transforms;f.identity();for(let A=0;A<v.length;A++){let S=v[A];if(S.sid&&S.sid.indexOf(m)!==-1)switch(g.type){case"revolute":f.multiply(d.makeRotationAxis(w,ii.degToRad(y)));break;case"prismatic":f.multiply(d.makeTranslation(w.x*y,w.y*y,w.z*y));break;default:console.warn("THREE.ColladaLoader: Unknown joint type: "+g.type);break}else switch(S.type){case"matrix":f.multiply(S.obj);break;case"translate":f.multiply(d.makeTranslation(S.obj.x,S.obj.y,S.obj.z));break;case"scale":f.scale(S.obj);break;case"rotate":f.multiply(d.makeRotationAxis(S.obj,S.angle));break}}_.matrix.copy(f),_.matrix.decompose(_.position,_.quaternion,_.scale),l[m].position=y}}else console.warn("THREE.ColladaLoader: Joint "+m+" does not exist.")}}}buildTransformList(t){let e=[],n=this.collada.querySelector('[id="'+t.id+'"]');for(let i=0;i<n.childNodes.length;i++){let r=n.childNodes[i];if(r.nodeType!==1)continue;let o,a;switch(r.nodeName){case"matrix":o=ri(r.textContent);let l=new Nt().fromArray(o).transpose();e.push({sid:r.getAttribute("sid"),type:r.nodeName,obj:l});break;case"translate":case"scale":o=ri(r.textContent),a=new F().fromArray(o),e.push({sid:r.getAttribute("sid"),type:r.nodeName,obj:a});break;case"rotate":o=ri(r.textContent),a=new F().fromArray(o);let c=ii.degToRad(o[3]);e.push({sid:r.getAttribute("sid"),type:r.nodeName,obj:a,angle:c});break}}return e}buildSkeleton(t,e){let n=[],i=[],r,o,a;for(r=0;r<t.length;r++){let h=t[r],u;if(this.hasNode(h))u=this.getNode(h),this.buildBoneHierarchy(u,e,n);else if(this.hasVisualScene(h)){let f=this.library.visualScenes[h].children;for(let m=0;m<f.length;m++){let y=f[m];if(y.type==="JOINT"){let p=this.getNode(y.id);this.buildBoneHierarchy(p,e,n)}}}else console.error("THREE.ColladaLoader: Unable to find root bone of skeleton with ID:",h)}for(r=0;r<e.length;r++)for(o=0;o<n.length;o++)if(a=n[o],a.bone.name===e[r].name){i[r]=a,a.processed=!0;break}for(r=0;r<n.length;r++)a=n[r],a.processed===!1&&(i.push(a),a.processed=!0);let l=[],c=[];for(r=0;r<i.length;r++)a=i[r],l.push(a.bone),c.push(a.boneInverse);return new Al(l,c)}buildBoneHierarchy(t,e,n){t.traverse(function(i){if(i.isBone===!0){let r;for(let o=0;o<e.length;o++){let a=e[o];if(a.name===i.name){r=a.boneInverse;break}}r===void 0&&(r=new Nt),n.push({bone:i,boneInverse:r,processed:!1})}})}buildNode(t){let e=[],n=t.matrix,i=t.nodes,r=t.type,o=t.instanceCameras,a=t.instanceControllers,l=t.instanceLights,c=t.instanceGeometries,h=t.instanceNodes;for(let d=0,f=i.length;d<f;d++)e.push(this.getNode(i[d]));for(let d=0,f=o.length;d<f;d++){let m=this.getCamera(o[d]);m!==null&&e.push(m.clone())}for(let d=0,f=a.length;d<f;d++){let m=a[d],y=this.getController(m.id),p=this.getGeometry(y.id),g=this.buildObjects(p,m.materials),_=m.skeletons,w=y.skin.joints,v=this.buildSkeleton(_,w);for(let A=0,S=g.length;A<S;A++){let x=g[A];x.isSkinnedMesh&&(x.bind(v,y.skin.bindMatrix),x.normalizeSkinWeights()),e.push(x)}}for(let d=0,f=l.length;d<f;d++){let m=this.getLight(l[d]);m!==null&&e.push(m.clone())}for(let d=0,f=c.length;d<f;d++){let m=c[d],y=this.getGeometry(m.id),p=this.buildObjects(y,m.materials);for(let g=0,_=p.length;g<_;g++)e.push(p[g])}for(let d=0,f=h.length;d<f;d++)e.push(this.getNode(h[d]).clone());let u;if(i.length===0&&e.length===1)u=e[0];else{u=r==="JOINT"?new ya:new Ge;for(let d=0;d<e.length;d++)u.add(e[d])}return u.name=r==="JOINT"?t.sid:t.name,r!=="JOINT"&&this.hasPivotTransforms(t)?this.wrapWithTransformHierarchy(u,t):(u.matrix.copy(n),u.matrix.decompose(u.position,u.quaternion,u.scale),u)}wrapWithTransformHierarchy(t,e){let n=e.id;this.transformNodes[n]={};let i=e.transformOrder,r=e.transformData,o=new Ge;o.name=e.name;let a=o;for(let l=0;l<i.length;l++){let c=i[l],h=r[c],u=new Ge;switch(u.name=e.name+"_"+c,h.type){case"translate":u.position.set(h.x,h.y,h.z);break;case"rotate":{let d=new F(h.axis[0],h.axis[1],h.axis[2]),f=ii.degToRad(h.angle);u.quaternion.setFromAxisAngle(d,f),u.userData.rotationAxis=d;break}case"scale":u.scale.set(h.x,h.y,h.z);break;case"matrix":{new Nt().fromArray(h.array).transpose().decompose(u.position,u.quaternion,u.scale);break}}this.transformNodes[n][c]=u,a.add(u),a=u}return a.add(t),o}resolveMaterialBinding(t,e){let n=[];for(let i=0,r=t.length;i<r;i++){let o=e[t[i]];o===void 0?(console.warn("THREE.ColladaLoader: Material with key %s not found. Apply fallback material.",t[i]),n.push(this.fallbackMaterial)):n.push(this.getMaterial(o))}return n}get fallbackMaterial(){return this._fallbackMaterial===void 0&&(this._fallbackMaterial=new Ui({name:ni.DEFAULT_MATERIAL_NAME,color:16711935})),this._fallbackMaterial}buildObjects(t,e){let n=[];for(let i in t){let r=t[i],o=this.resolveMaterialBinding(r.materialKeys,e);if(o.length===0&&(i==="lines"||i==="linestrips"?o.push(new Xn):o.push(new qn)),i==="lines"||i==="linestrips")for(let h=0,u=o.length;h<u;h++){let d=o[h];if(d.isMeshPhongMaterial===!0||d.isMeshLambertMaterial===!0){let f=new Xn;f.color.copy(d.color),f.opacity=d.opacity,f.transparent=d.transparent,o[h]=f}}let a=r.data.attributes.skinIndex!==void 0,l=o.length===1?o[0]:o,c;switch(i){case"lines":c=new Bi(r.data,l);break;case"linestrips":c=new Cr(r.data,l);break;case"triangles":case"polygons":case"polylist":a?c=new Tl(r.data,l):c=new de(r.data,l);break}n.push(c)}return n}hasNode(t){return this.library.nodes[t]!==void 0}getNode(t){return this.getBuild(this.library.nodes[t],this.buildNode.bind(this))}buildVisualScene(t){let e=new Ge;e.name=t.name;let n=t.children;for(let i=0;i<n.length;i++){let r=n[i];e.add(this.getNode(r.id))}return e}hasVisualScene(t){return this.library.visualScenes[t]!==void 0}getVisualScene(t){return this.getBuild(this.library.visualScenes[t],this.buildVisualScene.bind(this))}parseScene(t){let e=wi(t,"instance_visual_scene")[0];return this.getVisualScene(this.parseId(e.getAttribute("url")))}parseId(t){return t.substring(1)}setupAnimations(){let t=this.library.clips;if(this.isEmpty(t)===!0){if(this.isEmpty(this.library.animations)===!1){let e=[];for(let n in this.library.animations){let i=this.getAnimation(n);for(let r=0,o=i.length;r<o;r++)e.push(i[r])}this.buildDeferredPivotAnimationTracks(e),this.animations.push(new ba("default",-1,e))}}else for(let e in t)this.animations.push(this.getAnimationClip(e))}buildDeferredPivotAnimationTracks(t){for(let e in this.deferredPivotAnimations){let n=this.library.nodes[e];if(!n)continue;let i=this.deferredPivotAnimations[e];this.buildTransformHierarchyTracks(e,i,n,t)}}buildTransformHierarchyTracks(t,e,n,i){let r=this.transformNodes[t];if(!r){console.warn("THREE.ColladaLoader: Transform hierarchy not found for node:",t);return}for(let o in e){let a=r[o];if(!a)continue;let l=n.transforms[o],c=n.transformData[o],h=e[o];switch(l){case"translate":this.buildHierarchyTranslateTrack(a,h,c,i);break;case"rotate":this.buildHierarchyRotateTrack(a,h,c,i);break;case"scale":this.buildHierarchyScaleTrack(a,h,c,i);break}}}buildHierarchyTranslateTrack(t,e,n,i){if(e.default&&e.default.stride===3){let c=e.default,h=new ei(t.uuid+".position",Array.from(c.times),Array.from(c.values)),u=this.getInterpolationInfo(e);this.applyInterpolation(h,u,e),i.push(h);return}let r=this.getTimesForAllAxes(e);if(r.length===0)return;let o=[],a=this.getInterpolationInfo(e);for(let c=0;c<r.length;c++){let h=r[c],u=this.getValueAtTime(e.X,h,n.x),d=this.getValueAtTime(e.Y,h,n.y),f=this.getValueAtTime(e.Z,h,n.z);o.push(u,d,f)}let l=new ei(t.uuid+".position",r,o);this.applyInterpolation(l,a),i.push(l)}buildHierarchyRotateTrack(t,e,n,i){let r=e.ANGLE||e.default;if(!r)return;let o=Array.from(r.times);if(o.length===0)return;let a=t.userData.rotationAxis||new F(n.axis[0],n.axis[1],n.axis[2]),l=new We,c=new We,h=[],u=this.getInterpolationInfo(e);for(let f=0;f<o.length;f++){let m=o[f],y=this.getValueAtTime(r,m,n.angle),p=ii.degToRad(y);l.setFromAxisAngle(a,p),f>0&&c.dot(l)<0&&(l.x=-l.x,l.y=-l.y,l.z=-l.z,l.w=-l.w),c.copy(l),h.push(l.x,l.y,l.z,l.w)}let d=new ws(t.uuid+".quaternion",o,h);this.applyInterpolation(d,u),i.push(d)}buildHierarchyScaleTrack(t,e,n,i){if(e.default&&e.default.stride===3){let c=e.default,h=new ei(t.uuid+".scale",Array.from(c.times),Array.from(c.values)),u=this.getInterpolationInfo(e);this.applyInterpolation(h,u,e),i.push(h);return}let r=this.getTimesForAllAxes(e);if(r.length===0)return;let o=[],a=this.getInterpolationInfo(e);for(let c=0;c<r.length;c++){let h=r[c],u=this.getValueAtTime(e.X,h,n.x),d=this.getValueAtTime(e.Y,h,n.y),f=this.getValueAtTime(e.Z,h,n.z);o.push(u,d,f)}let l=new ei(t.uuid+".scale",r,o);this.applyInterpolation(l,a),i.push(l)}};var Oa=class extends ni{load(t,e,n,i){let r=this,o=r.path===""?po.extractUrlBase(t):r.path,a=new Ts(r.manager);a.setPriority(r.priority),a.setCache(r.cache),a.setPath(r.path),a.setRequestHeader(r.requestHeader),a.setWithCredentials(r.withCredentials),a.load(t,function(l){try{e(r.parse(l,o))}catch(c){i?i(c):console.error(c),r.manager.itemError(t)}},n,i)}parse(t,e){if(t.length===0)return{scene:new Tr};let i=new wd().parse(t);if(i===null)return null;let{library:r,asset:o,collada:a}=i,l=new co(this.manager);l.setPriority(this.priority),l.setCache(this.cache),l.setPath(this.resourcePath||e).setCrossOrigin(this.crossOrigin);let c;hc&&(c=new hc(this.manager),c.setPriority(this.priority),c.setCache(this.cache),c.setPath(this.resourcePath||e),c.setRequestHeader(this.requestHeader),c.setWithCredentials(this.withCredentials));let h=new Td(r,a,l,c),{scene:u,animations:d,kinematics:f}=h.compose();return u.animations=d,o.upAxis==="Z_UP"&&(console.warn("THREE.ColladaLoader: You are loading an asset with a Z-UP coordinate system. The loader just rotates the asset to transform it into Y-UP. The vertex data are not converted, see #24289."),u.rotation.set(-Math.PI/2,0,0)),u.scale.multiplyScalar(o.unit),{get animations(){return console.warn("THREE.ColladaLoader: Please access animations over scene.animations now."),d},kinematics:f,library:r,scene:u}}};var Iv=new F,qP=new xi,Ad=new Nt,Dr=new Nt,Ed=new We,Cd=new F(1,1,1),Rd=new F,Fa=class extends sn{constructor(...t){super(...t),this.urdfNode=null,this.urdfName=""}copy(t,e){return super.copy(t,e),this.urdfNode=t.urdfNode,this.urdfName=t.urdfName,this}},Pd=class extends Fa{constructor(...t){super(...t),this.isURDFCollider=!0,this.type="URDFCollider"}},Ld=class extends Fa{constructor(...t){super(...t),this.isURDFVisual=!0,this.type="URDFVisual"}},uc=class extends Fa{constructor(...t){super(...t),this.isURDFLink=!0,this.type="URDFLink",this.name="",this.inertial={mass:0,origin:{xyz:[0,0,0],rpy:[0,0,0]},inertia:{ixx:0,ixy:0,ixz:0,iyy:0,iyz:0,izz:0}}}copy(t,e){return super.copy(t,e),this.inertial={mass:t.inertial.mass,origin:{xyz:[...t.inertial.origin.xyz],rpy:[...t.inertial.origin.rpy]},inertia:{...t.inertial.inertia}},this}},dc=class extends Fa{get jointType(){return this._jointType}set jointType(t){if(this.jointType!==t)switch(this._jointType=t,this.matrixWorldNeedsUpdate=!0,t){case"fixed":this.jointValue=[];break;case"continuous":case"revolute":case"prismatic":this.jointValue=new Array(1).fill(0);break;case"planar":this.jointValue=new Array(3).fill(0),this.axis=new F(0,0,1);break;case"floating":this.jointValue=new Array(6).fill(0);break}}get angle(){return this.jointValue[0]}constructor(...t){super(...t),this.isURDFJoint=!0,this.type="URDFJoint",this.name="",this.jointValue=null,this.jointType="fixed",this.axis=new F(1,0,0),this.limit={lower:0,upper:0,effort:0,velocity:0},this.ignoreLimits=!1,this.origPosition=null,this.origQuaternion=null,this.mimicJoints=[]}copy(t,e){return super.copy(t,e),this.jointType=t.jointType,this.axis=t.axis.clone(),this.limit.lower=t.limit.lower,this.limit.upper=t.limit.upper,this.limit.effort=t.limit.effort,this.limit.velocity=t.limit.velocity,this.ignoreLimits=!1,this.jointValue=[...t.jointValue],this.origPosition=t.origPosition?t.origPosition.clone():null,this.origQuaternion=t.origQuaternion?t.origQuaternion.clone():null,this.mimicJoints=[...t.mimicJoints],this}setJointValue(...t){t=t.map(n=>n===null?null:parseFloat(n)),(!this.origPosition||!this.origQuaternion)&&(this.origPosition=this.position.clone(),this.origQuaternion=this.quaternion.clone());let e=!1;switch(this.mimicJoints.forEach(n=>{e=n.updateFromMimickedJoint(...t)||e}),this.jointType){case"fixed":return e;case"continuous":case"revolute":{let n=t[0];return n==null||n===this.jointValue[0]?e:(!this.ignoreLimits&&this.jointType==="revolute"&&(n=Math.min(this.limit.upper,n),n=Math.max(this.limit.lower,n)),this.quaternion.setFromAxisAngle(this.axis,n).premultiply(this.origQuaternion),this.jointValue[0]!==n?(this.jointValue[0]=n,this.matrixWorldNeedsUpdate=!0,!0):e)}case"prismatic":{let n=t[0];return n==null||n===this.jointValue[0]?e:(this.ignoreLimits||(n=Math.min(this.limit.upper,n),n=Math.max(this.limit.lower,n)),this.position.copy(this.origPosition),Iv.copy(this.axis).applyEuler(this.rotation),this.position.addScaledVector(Iv,n),this.jointValue[0]!==n?(this.jointValue[0]=n,this.matrixWorldNeedsUpdate=!0,!0):e)}case"floating":return this.jointValue.every((n,i)=>t[i]===n||t[i]===null)?e:(this.jointValue[0]=t[0]!==null?t[0]:this.jointValue[0],this.jointValue[1]=t[1]!==null?t[1]:this.jointValue[1],this.jointValue[2]=t[2]!==null?t[2]:this.jointValue[2],this.jointValue[3]=t[3]!==null?t[3]:this.jointValue[3],this.jointValue[4]=t[4]!==null?t[4]:this.jointValue[4],this.jointValue[5]=t[5]!==null?t[5]:this.jointValue[5],Dr.compose(this.origPosition,this.origQuaternion,Cd),Ed.setFromEuler(qP.set(this.jointValue[3],this.jointValue[4],this.jointValue[5],"XYZ")),Rd.set(this.jointValue[0],this.jointValue[1],this.jointValue[2]),Ad.compose(Rd,Ed,Cd),Dr.premultiply(Ad),this.position.setFromMatrixPosition(Dr),this.rotation.setFromRotationMatrix(Dr),this.matrixWorldNeedsUpdate=!0,!0);case"planar":return this.jointValue.every((n,i)=>t[i]===n||t[i]===null)?e:(this.jointValue[0]=t[0]!==null?t[0]:this.jointValue[0],this.jointValue[1]=t[1]!==null?t[1]:this.jointValue[1],this.jointValue[2]=t[2]!==null?t[2]:this.jointValue[2],Dr.compose(this.origPosition,this.origQuaternion,Cd),Ed.setFromAxisAngle(this.axis,this.jointValue[2]),Rd.set(this.jointValue[0],this.jointValue[1],0),Ad.compose(Rd,Ed,Cd),Dr.premultiply(Ad),this.position.setFromMatrixPosition(Dr),this.rotation.setFromRotationMatrix(Dr),this.matrixWorldNeedsUpdate=!0,!0)}return e}},fc=class extends dc{constructor(...t){super(...t),this.type="URDFMimicJoint",this.mimicJoint=null,this.offset=0,this.multiplier=1}updateFromMimickedJoint(...t){let e=t.map(n=>n===null?null:n*this.multiplier+this.offset);return super.setJointValue(...e)}copy(t,e){return super.copy(t,e),this.mimicJoint=t.mimicJoint,this.offset=t.offset,this.multiplier=t.multiplier,this}},Id=class extends uc{constructor(...t){super(...t),this.isURDFRobot=!0,this.urdfNode=null,this.urdfRobotNode=null,this.robotName=null,this.links=null,this.joints=null,this.colliders=null,this.visual=null,this.frames=null}copy(t,e){super.copy(t,e),this.urdfRobotNode=t.urdfRobotNode,this.robotName=t.robotName,this.links={},this.joints={},this.colliders={},this.visual={},this.traverse(n=>{n.isURDFJoint&&n.urdfName in t.joints&&(this.joints[n.urdfName]=n),n.isURDFLink&&n.urdfName in t.links&&(this.links[n.urdfName]=n),n.isURDFCollider&&n.urdfName in t.colliders&&(this.colliders[n.urdfName]=n),n.isURDFVisual&&n.urdfName in t.visual&&(this.visual[n.urdfName]=n)});for(let n in this.joints)this.joints[n].mimicJoints=this.joints[n].mimicJoints.map(i=>this.joints[i.name]);return this.frames={...this.colliders,...this.visual,...this.links,...this.joints},this}getFrame(t){return this.frames[t]}setJointValue(t,...e){let n=this.joints[t];return n?n.setJointValue(...e):!1}setJointValues(t){let e=!1;for(let n in t){let i=t[n];Array.isArray(i)?e=this.setJointValue(n,...i)||e:e=this.setJointValue(n,i)||e}return e}};var Wm=new We,Nv=new xi;function Or(s){return s?s.trim().split(/\s+/g).map(t=>parseFloat(t)):[0,0,0]}function Dv(s,t,e=!1){e||s.rotation.set(0,0,0),Nv.set(t[0],t[1],t[2],"ZYX"),Wm.setFromEuler(Nv),Wm.multiply(s.quaternion),s.quaternion.copy(Wm)}var Xm=class{constructor(t){this.manager=t||id,this.loadMeshCb=this.defaultMeshLoader.bind(this),this.parseVisual=!0,this.parseCollision=!1,this.packages="",this.workingPath="",this.fetchOptions={}}loadAsync(t){return new Promise((e,n)=>{this.load(t,e,null,n)})}load(t,e,n,i){let r=this.manager,o=po.extractUrlBase(t),a=this.manager.resolveURL(t);r.itemStart(a),fetch(a,this.fetchOptions).then(l=>{if(l.ok)return n&&n(null),l.text();throw new Error(`URDFLoader: Failed to load url '${a}' with error code ${l.status} : ${l.statusText}.`)}).then(l=>{let c=this.parse(l,this.workingPath||o);e(c),r.itemEnd(a)}).catch(l=>{i?i(l):console.error("URDFLoader: Error loading file.",l),r.itemError(a),r.itemEnd(a)})}parse(t,e=this.workingPath){let n=this.packages,i=this.loadMeshCb,r=this.parseVisual,o=this.parseCollision,a=this.manager,l={},c={},h={};function u(_){if(!/^package:\/\//.test(_))return e?e+_:_;let[w,v]=_.replace(/^package:\/\//,"").split(/\/(.+)/);if(typeof n=="string")return n.endsWith(w)?n+"/"+v:n+"/"+w+"/"+v;if(typeof n=="function")return n(w)+"/"+v;if(typeof n=="object")return w in n?n[w]+"/"+v:(console.error(`URDFLoader : ${w} not found in provided package list.`),null)}function d(_){let w;_ instanceof Document?w=[..._.children]:_ instanceof Element?w=[_]:w=[...new DOMParser().parseFromString(_,"text/xml").children];let v=w.filter(A=>A.nodeName==="robot").pop();return f(v)}function f(_){let w=[..._.children],v=w.filter(R=>R.nodeName.toLowerCase()==="link"),A=w.filter(R=>R.nodeName.toLowerCase()==="joint"),S=w.filter(R=>R.nodeName.toLowerCase()==="material"),x=new Id;x.robotName=_.getAttribute("name"),x.urdfRobotNode=_,S.forEach(R=>{let O=R.getAttribute("name");h[O]=p(R)});let M={},L={};v.forEach(R=>{let O=R.getAttribute("name"),k=_.querySelector(`child[link="${O}"]`)===null;l[O]=y(R,M,L,k?x:null)}),A.forEach(R=>{let O=R.getAttribute("name");c[O]=m(R)}),x.joints=c,x.links=l,x.colliders=L,x.visual=M;let P=Object.values(c);return P.forEach(R=>{R instanceof fc&&c[R.mimicJoint].mimicJoints.push(R)}),P.forEach(R=>{let O=new Set,k=N=>{if(O.has(N))throw new Error("URDFLoader: Detected an infinite loop of mimic joints.");O.add(N),N.mimicJoints.forEach(W=>{k(W)})};k(R)}),x.frames={...L,...M,...l,...c},x}function m(_){let w=[..._.children],v=_.getAttribute("type"),A,S=w.find(O=>O.nodeName.toLowerCase()==="mimic");S?(A=new fc,A.mimicJoint=S.getAttribute("joint"),A.multiplier=parseFloat(S.getAttribute("multiplier")||1),A.offset=parseFloat(S.getAttribute("offset")||0)):A=new dc,A.urdfNode=_,A.name=_.getAttribute("name"),A.urdfName=A.name,A.jointType=v;let x=null,M=null,L=[0,0,0],P=[0,0,0];w.forEach(O=>{let k=O.nodeName.toLowerCase();k==="origin"?(L=Or(O.getAttribute("xyz")),P=Or(O.getAttribute("rpy"))):k==="child"?M=l[O.getAttribute("link")]:k==="parent"?x=l[O.getAttribute("link")]:k==="limit"&&(A.limit.lower=parseFloat(O.getAttribute("lower")||A.limit.lower),A.limit.upper=parseFloat(O.getAttribute("upper")||A.limit.upper),A.limit.effort=parseFloat(O.getAttribute("effort")||A.limit.effort),A.limit.velocity=parseFloat(O.getAttribute("velocity")||A.limit.velocity))}),x.add(A),A.add(M),Dv(A,P),A.position.set(L[0],L[1],L[2]);let R=w.filter(O=>O.nodeName.toLowerCase()==="axis")[0];if(R){let O=R.getAttribute("xyz").split(/\s+/g).map(k=>parseFloat(k));A.axis=new F(O[0],O[1],O[2]),A.axis.normalize()}return A}function y(_,w,v,A=null){A===null&&(A=new uc);let S=[..._.children];A.name=_.getAttribute("name"),A.urdfName=A.name,A.urdfNode=_;let x=S.find(M=>M.nodeName.toLowerCase()==="inertial");return x&&[...x.children].forEach(M=>{let L=M.nodeName.toLowerCase();L==="origin"?(A.inertial.origin.xyz=Or(M.getAttribute("xyz")),A.inertial.origin.rpy=Or(M.getAttribute("rpy"))):L==="mass"?A.inertial.mass=parseFloat(M.getAttribute("value"))||0:L==="inertia"&&(A.inertial.inertia.ixx=parseFloat(M.getAttribute("ixx"))||0,A.inertial.inertia.ixy=parseFloat(M.getAttribute("ixy"))||0,A.inertial.inertia.ixz=parseFloat(M.getAttribute("ixz"))||0,A.inertial.inertia.iyy=parseFloat(M.getAttribute("iyy"))||0,A.inertial.inertia.iyz=parseFloat(M.getAttribute("iyz"))||0,A.inertial.inertia.izz=parseFloat(M.getAttribute("izz"))||0)}),r&&S.filter(L=>L.nodeName.toLowerCase()==="visual").forEach(L=>{let P=g(L,h);if(A.add(P),L.hasAttribute("name")){let R=L.getAttribute("name");P.name=R,P.urdfName=R,w[R]=P}}),o&&S.filter(L=>L.nodeName.toLowerCase()==="collision").forEach(L=>{let P=g(L);if(A.add(P),L.hasAttribute("name")){let R=L.getAttribute("name");P.name=R,P.urdfName=R,v[R]=P}}),A}function p(_){let w=[..._.children],v=new qn;return v.name=_.getAttribute("name")||"",w.forEach(A=>{let S=A.nodeName.toLowerCase();if(S==="color"){let x=A.getAttribute("rgba").split(/\s/g).map(M=>parseFloat(M));v.color.setRGB(x[0],x[1],x[2]),v.opacity=x[3],v.transparent=x[3]<1,v.depthWrite=!v.transparent}else if(S==="texture"){let x=A.getAttribute("filename");if(x){let M=new co(a),L=u(x);v.map=M.load(L),v.map.colorSpace=Te}}}),v}function g(_,w={}){let v=_.nodeName.toLowerCase()==="collision",A=[..._.children],S=null,x=A.filter(L=>L.nodeName.toLowerCase()==="material")[0];if(x){let L=x.getAttribute("name");L&&L in w?S=w[L]:S=p(x)}else S=new qn;let M=v?new Pd:new Ld;return M.urdfNode=_,A.forEach(L=>{let P=L.nodeName.toLowerCase();if(P==="geometry"){let R=L.children[0].nodeName.toLowerCase();if(R==="mesh"){let O=L.children[0].getAttribute("filename"),k=u(O);if(k!==null){let N=L.children[0].getAttribute("scale");if(N){let W=Or(N);M.scale.set(W[0],W[1],W[2])}i(k,a,S,(W,z)=>{z?console.error("URDFLoader: Error loading mesh.",z):W&&(W.position.set(0,0,0),W.quaternion.identity(),M.add(W))})}}else if(R==="box"){let O=new de;O.geometry=new Ms(1,1,1),O.material=S;let k=Or(L.children[0].getAttribute("size"));O.scale.set(k[0],k[1],k[2]),M.add(O)}else if(R==="sphere"){let O=new de;O.geometry=new er(1,30,30),O.material=S;let k=parseFloat(L.children[0].getAttribute("radius"))||0;O.scale.set(k,k,k),M.add(O)}else if(R==="cylinder"){let O=new de;O.geometry=new tr(1,1,1,30),O.material=S;let k=parseFloat(L.children[0].getAttribute("radius"))||0,N=parseFloat(L.children[0].getAttribute("length"))||0;O.scale.set(k,N,k),O.rotation.set(Math.PI/2,0,0),M.add(O)}}else if(P==="origin"){let R=Or(L.getAttribute("xyz")),O=Or(L.getAttribute("rpy"));M.position.set(R[0],R[1],R[2]),M.rotation.set(0,0,0),Dv(M,O)}}),M}return d(t)}defaultMeshLoader(t,e,n,i){/\.stl$/i.test(t)?new Da(e).load(t,o=>{let a=new de(o,n||new qn);i(a)},null,o=>i(null,o)):/\.dae$/i.test(t)?new Oa(e).load(t,o=>i(o.scene),null,o=>i(null,o)):console.warn(`URDFLoader: Could not load model at ${t}.
No loader available`)}},Ov=Xm;var qm=.028,jP=25,Fv=36;function Uv(s){let{r:t,g:e,b:n}=s.color;s.color.setRGB(t,e,n,Te);let{color:i}=s;i.setRGB(Math.max(i.r,qm),Math.max(i.g,qm),Math.max(i.b,qm)),s.specular.setScalar(.03),s.shininess=24}function Bv(s,t){let n=s.geometry instanceof tr?YP():new oo(s.geometry,jP),i=new Bi(n,t);return i.raycast=()=>{},s.add(i),i}function YP(){let s=[];for(let t of[-.502,.502]){for(let e=0;e<Fv;e++)for(let n of[e,e+1].map(i=>2*Math.PI*i/Fv))s.push(Math.cos(n),t,Math.sin(n));s.push(.3,t,0,.85,t,0,-.3,t,0,-.85,t,0),s.push(0,t,.3,0,t,.85,0,t,-.3,0,t,-.85)}return new Ae().setAttribute("position",new $t(s,3))}function kv(s){return new Ui({color:new Rt(s),transparent:!0,opacity:.28,depthWrite:!1,polygonOffset:!0,polygonOffsetFactor:-1,polygonOffsetUnits:-1})}var Nd=class{originals=new Map;set(t,e){this.clear();for(let n of t){this.originals.set(n,n.material);let i=[n.material].flat().map(r=>{let o=r.clone();return o instanceof qn&&(o.color.lerp(new Rt(e),.8),o.emissive.set(e),o.emissiveIntensity=.2),o});n.material=Array.isArray(n.material)?i:i[0]}}clear(){for(let[t,e]of this.originals)[t.material].flat().forEach(n=>n.dispose()),t.material=e;this.originals.clear()}};function Dd(s){s.traverse(t=>{(t instanceof de||t instanceof Bi)&&(t.geometry.dispose(),[t.material].flat().forEach(e=>{e instanceof qn&&e.map?.dispose(),e.dispose()}))})}var $P=/^[og]\s*(.+)?/,JP=/^mtllib /,KP=/^usemtl /,ZP=/^usemap /,Od=/\s+/,zv=new F,jm=new F,Vv=new F,Gv=new F,Ki=new F,Fd=new Rt;function QP(){let s={objects:[],object:{},vertices:[],normals:[],colors:[],uvs:[],materials:{},materialLibraries:[],startObject:function(t,e){if(this.object&&this.object.fromDeclaration===!1){this.object.name=t,this.object.fromDeclaration=e!==!1;return}let n=this.object&&typeof this.object.currentMaterial=="function"?this.object.currentMaterial():void 0;if(this.object&&typeof this.object._finalize=="function"&&this.object._finalize(!0),this.object={name:t||"",fromDeclaration:e!==!1,geometry:{vertices:[],normals:[],colors:[],uvs:[],hasUVIndices:!1},materials:[],smooth:!0,startMaterial:function(i,r){let o=this._finalize(!1);o&&(o.inherited||o.groupCount<=0)&&this.materials.splice(o.index,1);let a={index:this.materials.length,name:i||"",mtllib:Array.isArray(r)&&r.length>0?r[r.length-1]:"",smooth:o!==void 0?o.smooth:this.smooth,groupStart:o!==void 0?o.groupEnd:0,groupEnd:-1,groupCount:-1,inherited:!1,clone:function(l){let c={index:typeof l=="number"?l:this.index,name:this.name,mtllib:this.mtllib,smooth:this.smooth,groupStart:0,groupEnd:-1,groupCount:-1,inherited:!1};return c.clone=this.clone.bind(c),c}};return this.materials.push(a),a},currentMaterial:function(){if(this.materials.length>0)return this.materials[this.materials.length-1]},_finalize:function(i){let r=this.currentMaterial();if(r&&r.groupEnd===-1&&(r.groupEnd=this.geometry.vertices.length/3,r.groupCount=r.groupEnd-r.groupStart,r.inherited=!1),i&&this.materials.length>1)for(let o=this.materials.length-1;o>=0;o--)this.materials[o].groupCount<=0&&this.materials.splice(o,1);return i&&this.materials.length===0&&this.materials.push({name:"",smooth:this.smooth}),r}},n&&n.name&&typeof n.clone=="function"){let i=n.clone(0);i.inherited=!0,this.object.materials.push(i)}this.objects.push(this.object)},finalize:function(){this.object&&typeof this.object._finalize=="function"&&this.object._finalize(!0)},parseVertexIndex:function(t,e){let n=parseInt(t,10);return(n>=0?n-1:n+e/3)*3},parseNormalIndex:function(t,e){let n=parseInt(t,10);return(n>=0?n-1:n+e/3)*3},parseUVIndex:function(t,e){let n=parseInt(t,10);return(n>=0?n-1:n+e/2)*2},addVertex:function(t,e,n){let i=this.vertices,r=this.object.geometry.vertices;r.push(i[t+0],i[t+1],i[t+2]),r.push(i[e+0],i[e+1],i[e+2]),r.push(i[n+0],i[n+1],i[n+2])},addVertexPoint:function(t){let e=this.vertices;this.object.geometry.vertices.push(e[t+0],e[t+1],e[t+2])},addVertexLine:function(t){let e=this.vertices;this.object.geometry.vertices.push(e[t+0],e[t+1],e[t+2])},addNormal:function(t,e,n){let i=this.normals,r=this.object.geometry.normals;r.push(i[t+0],i[t+1],i[t+2]),r.push(i[e+0],i[e+1],i[e+2]),r.push(i[n+0],i[n+1],i[n+2])},addFaceNormal:function(t,e,n){let i=this.vertices,r=this.object.geometry.normals;zv.fromArray(i,t),jm.fromArray(i,e),Vv.fromArray(i,n),Ki.subVectors(Vv,jm),Gv.subVectors(zv,jm),Ki.cross(Gv),Ki.normalize(),r.push(Ki.x,Ki.y,Ki.z),r.push(Ki.x,Ki.y,Ki.z),r.push(Ki.x,Ki.y,Ki.z)},addColor:function(t,e,n){let i=this.colors,r=this.object.geometry.colors;i[t]!==void 0&&r.push(i[t+0],i[t+1],i[t+2]),i[e]!==void 0&&r.push(i[e+0],i[e+1],i[e+2]),i[n]!==void 0&&r.push(i[n+0],i[n+1],i[n+2])},addUV:function(t,e,n){let i=this.uvs,r=this.object.geometry.uvs;r.push(i[t+0],i[t+1]),r.push(i[e+0],i[e+1]),r.push(i[n+0],i[n+1])},addDefaultUV:function(){let t=this.object.geometry.uvs;t.push(0,0),t.push(0,0),t.push(0,0)},addUVLine:function(t){let e=this.uvs;this.object.geometry.uvs.push(e[t+0],e[t+1])},addFace:function(t,e,n,i,r,o,a,l,c){let h=this.vertices.length,u=this.parseVertexIndex(t,h),d=this.parseVertexIndex(e,h),f=this.parseVertexIndex(n,h);if(this.addVertex(u,d,f),this.addColor(u,d,f),a!==void 0&&a!==""){let m=this.normals.length;u=this.parseNormalIndex(a,m),d=this.parseNormalIndex(l,m),f=this.parseNormalIndex(c,m),this.addNormal(u,d,f)}else this.addFaceNormal(u,d,f);if(i!==void 0&&i!==""){let m=this.uvs.length;u=this.parseUVIndex(i,m),d=this.parseUVIndex(r,m),f=this.parseUVIndex(o,m),this.addUV(u,d,f),this.object.geometry.hasUVIndices=!0}else this.addDefaultUV()},addPointGeometry:function(t){this.object.geometry.type="Points";let e=this.vertices.length;for(let n=0,i=t.length;n<i;n++){let r=this.parseVertexIndex(t[n],e);this.addVertexPoint(r),this.addColor(r)}},addLineGeometry:function(t,e){this.object.geometry.type="Line";let n=this.vertices.length,i=this.uvs.length;for(let r=0,o=t.length-1;r<o;r++)this.addVertexLine(this.parseVertexIndex(t[r],n)),this.addVertexLine(this.parseVertexIndex(t[r+1],n));for(let r=0,o=e.length-1;r<o;r++)this.addUVLine(this.parseUVIndex(e[r],i)),this.addUVLine(this.parseUVIndex(e[r+1],i))}};return s.startObject("",!1),s}var Ud=class extends ni{constructor(t){super(t),this.materials=null}load(t,e,n,i){let r=this,o=new Ts(this.manager);o.setPriority(this.priority),o.setCache(this.cache),o.setPath(this.path),o.setRequestHeader(this.requestHeader),o.setWithCredentials(this.withCredentials),o.load(t,function(a){try{e(r.parse(a))}catch(l){i?i(l):console.error(l),r.manager.itemError(t)}},n,i)}setMaterials(t){return this.materials=t,this}parse(t){let e=new QP;t.indexOf(`\r
`)!==-1&&(t=t.replace(/\r\n/g,`
`)),t.indexOf(`\\
`)!==-1&&(t=t.replace(/\\\n/g,""));let n=t.split(`
`),i=[];for(let a=0,l=n.length;a<l;a++){let c=n[a].trimStart();if(c.length===0)continue;let h=c.charAt(0);if(h!=="#")if(h==="v"){let u=c.split(Od);switch(u[0]){case"v":e.vertices.push(parseFloat(u[1]),parseFloat(u[2]),parseFloat(u[3])),u.length>=7?(Fd.setRGB(parseFloat(u[4]),parseFloat(u[5]),parseFloat(u[6]),Te),e.colors.push(Fd.r,Fd.g,Fd.b)):e.colors.push(void 0,void 0,void 0);break;case"vn":e.normals.push(parseFloat(u[1]),parseFloat(u[2]),parseFloat(u[3]));break;case"vt":e.uvs.push(parseFloat(u[1]),parseFloat(u[2]));break}}else if(h==="f"){let d=c.slice(1).trim().split(Od),f=[];for(let y=0,p=d.length;y<p;y++){let g=d[y];if(g.length>0){let _=g.split("/");f.push(_)}}let m=f[0];for(let y=1,p=f.length-1;y<p;y++){let g=f[y],_=f[y+1];e.addFace(m[0],g[0],_[0],m[1],g[1],_[1],m[2],g[2],_[2])}}else if(h==="l"){let u=c.substring(1).trim().split(Od),d=[],f=[];if(c.indexOf("/")===-1)d=u;else for(let m=0,y=u.length;m<y;m++){let p=u[m].split("/");p[0]!==""&&d.push(p[0]),p[1]!==""&&f.push(p[1])}e.addLineGeometry(d,f)}else if(h==="p"){let d=c.slice(1).trim().split(Od);e.addPointGeometry(d)}else if((i=$P.exec(c))!==null){let u=(" "+i[0].slice(1).trim()).slice(1);e.startObject(u)}else if(KP.test(c))e.object.startMaterial(c.substring(7).trim(),e.materialLibraries);else if(JP.test(c))e.materialLibraries.push(c.substring(7).trim());else if(ZP.test(c))console.warn('THREE.OBJLoader: Rendering identifier "usemap" not supported. Textures must be defined in MTL files.');else if(h==="s"){if(i=c.split(" "),i.length>1){let d=i[1].trim().toLowerCase();e.object.smooth=d!=="0"&&d!=="off"}else e.object.smooth=!0;let u=e.object.currentMaterial();u&&(u.smooth=e.object.smooth)}else{if(c==="\0")continue;console.warn('THREE.OBJLoader: Unexpected line: "'+c+'"')}}e.finalize();let r=new Ge;if(r.materialLibraries=[].concat(e.materialLibraries),!(e.objects.length===1&&e.objects[0].geometry.vertices.length===0)===!0)for(let a=0,l=e.objects.length;a<l;a++){let c=e.objects[a],h=c.geometry,u=c.materials,d=h.type==="Line",f=h.type==="Points",m=!1;if(h.vertices.length===0)continue;let y=new Ae;y.setAttribute("position",new $t(h.vertices,3)),h.normals.length>0&&y.setAttribute("normal",new $t(h.normals,3)),h.colors.length>0&&(m=!0,y.setAttribute("color",new $t(h.colors,3))),h.hasUVIndices===!0&&y.setAttribute("uv",new $t(h.uvs,2));let p=[];for(let _=0,w=u.length;_<w;_++){let v=u[_],A=v.name+"_"+v.smooth+"_"+m,S=e.materials[A];if(this.materials!==null){if(S=this.materials.create(v.name),d&&S&&!(S instanceof Xn)){let x=new Xn;gi.prototype.copy.call(x,S),x.color.copy(S.color),S=x}else if(f&&S&&!(S instanceof cs)){let x=new cs({size:10,sizeAttenuation:!1});gi.prototype.copy.call(x,S),x.color.copy(S.color),x.map=S.map,S=x}}S===void 0&&(d?S=new Xn:f?S=new cs({size:1,sizeAttenuation:!1}):S=new qn,S.name=v.name,S.flatShading=!v.smooth,S.vertexColors=m,e.materials[A]=S),p.push(S)}let g;if(p.length>1){for(let _=0,w=u.length;_<w;_++){let v=u[_];y.addGroup(v.groupStart,v.groupCount,_)}d?g=new Bi(y,p):f?g=new Zs(y,p):g=new de(y,p)}else d?g=new Bi(y,p[0]):f?g=new Zs(y,p[0]):g=new de(y,p[0]);g.name=c.name,r.add(g)}else if(e.vertices.length>0){let a=new cs({size:1,sizeAttenuation:!1}),l=new Ae;l.setAttribute("position",new $t(e.vertices,3)),e.colors.length>0&&e.colors[0]!==void 0&&(l.setAttribute("color",new $t(e.colors,3)),a.vertexColors=!0);let c=new Zs(l,a);r.add(c)}return r}};function Hv(s){let t=new Sa;return t.setURLModifier(e=>{let n=s[e];if(n===void 0)throw new Error(`'${e}' was not found`);return n}),t}async function Wv(s,t,e,n){let i=t[s];if(i===void 0)throw new Error(`the mesh '${s}' was not found`);let r=await fetch(i);if(!r.ok)throw new Error(`the mesh '${s}' was not served: ${r.status} ${r.statusText}`);switch(/\.(\w+)$/.exec(i)?.[1]){case"stl":return new de(new Da().parse(await r.arrayBuffer()),qv(n));case"obj":return Xv(new Ud(e).parse(await r.text()),n);case"dae":return tL(await r.text(),eL(s),t,e,n);default:throw new Error(`'${s}' is of a kind that is not drawn here: .stl, .dae, .obj and glTF are`)}}function tL(s,t,e,n,i){let r=new DOMParser().parseFromString(s,"text/xml");r.querySelectorAll("up_axis").forEach(h=>h.textContent="Y_UP"),r.querySelectorAll("library_images > image").forEach(h=>{let u=h.querySelector("init_from"),d=(u?.textContent??"").trim().replace(/^\.\//,"");u===null||e[t+d]===void 0?h.remove():u.textContent=d});let o=new Oa(n);o.setResourcePath(t);let a=o.parse(new XMLSerializer().serializeToString(r),t);if(a===null)throw new Error("it is no COLLADA file");let{scene:l}=a,c=[];return l.traverse(h=>{(h instanceof As||h instanceof ho)&&c.push(h)}),c.forEach(h=>h.removeFromParent()),Xv(l,i)}function Xv(s,t){return s.traverse(e=>{if(!(e instanceof de))return;let n=[e.material].flat(),i=n.every(({name:r,map:o})=>r===""&&!o);e.material=i?qv(t):e.material,n.forEach(r=>r.side=yi)}),s}function qv(s){return s.side=yi,s}function eL(s){return s.slice(0,s.lastIndexOf("/")+1)}function Bd(s,t){let e=[],n=i=>{"isURDFCollider"in i||!t&&"isURDFJoint"in i||(i instanceof de&&e.push(i),i.children.forEach(n))};return n(s),e}function jv(s){return"parameters"in s.geometry}function Yv(s){let t=s.children.find(r=>"isURDFLink"in r);if(t===void 0)return 0;let e=t.matrixWorld.clone().invert(),n=new F,i=0;for(let r of Bd(t,!1)){let o=r.geometry.getAttribute("position"),a=e.clone().multiply(r.matrixWorld);for(let l=0;l<o.count;l++){n.fromBufferAttribute(o,l).applyMatrix4(a);let c=n.dot(s.axis);i=Math.max(i,Math.sqrt(Math.max(0,n.lengthSq()-c*c)))}}return i}var Vn="world",kd=class s{constructor(t=new Map){this.anchors=t}anchors;places=new Map;bases=new Map;fixed=null;at(t,e,n){let i=new s(this.anchors);return i.update(t,e,n),i}clear(){this.anchors.clear()}forget(t){this.anchors.delete(t)}update(t,e,n){this.places=new Map([[Vn,{reference:Vn,pose:new Nt}]]),this.bases=new Map;let i=this.placeRoots(t,e),r=new Map;for(let a of e)this.placeBody(t,a,i,r);for(let a of t.names)this.placeFrame(t,a,i,r);let o=this.places.get(n);this.fixed=o?{...o,pose:o.pose.clone().invert()}:null}poseOf(t){return this.inFixed(this.places.get(t))}poseOfBody(t){return this.inFixed(this.bases.get(t))}inFixed(t){return t===void 0||this.fixed===null||t.reference!==this.fixed.reference?null:this.fixed.pose.clone().multiply(t.pose)}placeRoots(t,e){let n=new Map;if(t.has(Vn)){let i=t.inRoot(Vn);i!==null&&n.set(t.rootOf(Vn),{reference:Vn,pose:i.invert()})}for(let{base:i,truth:r}of e){let o=t.rootOf(i);if(n.has(o)||!t.has(i))continue;let a=this.anchors.get(o)??nL(r,t.inRoot(i));a!==null&&(this.anchors.set(o,a),n.set(o,{reference:Vn,pose:a}))}return n}placeBody(t,e,n,i){let r=t.rootOf(e.base),{reference:o,pose:a}=n.get(r)??{reference:r,pose:new Nt},l=t.inRoot(e.base),c=e.truth!==null?{reference:Vn,pose:e.truth}:l&&{reference:o,pose:a.clone().multiply(l)};if(c!==null){this.bases.set(e,c),t.has(e.base)||this.places.set(e.base,c);for(let[h,u]of e.links)i.set(h,{...c,pose:c.pose.clone().multiply(u)})}}placeFrame(t,e,n,i){let r=t.parentOf(e),o=n.get(t.rootOf(e))??{reference:t.rootOf(e),pose:new Nt},a=i.get(e);if(a!==void 0||r===null){this.places.set(e,a??o);return}let l=this.places.get(r),c=t.localOf(e);if(l!==void 0&&c!==null){let h=l.pose.clone().multiply(c);this.places.set(e,{reference:l.reference,pose:h})}}};function nL(s,t){return s&&t&&s.clone().multiply(t.invert())}var Ym="#0fa3b1",$m="#f2811d",pc={light:{horizon:"#e9edf1",zenith:"#c9d6e3",ground:"#dfe4e9",gridMinor:"#bcc6d1",gridMajor:"#8896a6",edge:"#26323f",edgeOpacity:.28,partEdge:"#ffffff",partEdgeOpacity:.35,axes:["#e03a3a","#22a047","#2f6fed"],tree:"#8a6d1f",label:"#1d2733",labelFixed:"#0b5cad",labelBack:"rgba(255, 255, 255, 0.78)",contact:"#1f9d55",slip:"#d6246e",scans:["#e11d2e","#7a3ff2","#0b7a3b"],distance:"#7a3ff2",touch:"#e11d2e",highlight:"#ff9d00",collision:"#d97706",sun:2.3,sky:1.7,shadow:.26},dark:{horizon:"#161b21",zenith:"#0d1116",ground:"#20262e",gridMinor:"#3a4450",gridMajor:"#5a6878",edge:"#dbe6f2",edgeOpacity:.22,partEdge:"#ffffff",partEdgeOpacity:.4,axes:["#ff5c5c","#46cf6f","#6b9dff"],tree:"#d9b650",label:"#e8eef5",labelFixed:"#7cc0ff",labelBack:"rgba(16, 21, 27, 0.74)",contact:"#3ddc84",slip:"#ff5fa2",scans:["#ff4d5e","#b48cff","#4be08a"],distance:"#b48cff",touch:"#ff4d5e",highlight:"#ffb02e",collision:"#f59e0b",sun:2,sky:1.5,shadow:.5}};var mc=class extends Error{name="BadModel"};function $v(s,t,e){let n=new DOMParser().parseFromString(s,"text/xml"),i=n.querySelector("parsererror");if(i!==null||n.documentElement.localName!=="robot")throw new mc(`the robot's description is no URDF: ${i?.textContent??""}`.trim());for(let r of n.querySelectorAll("material > texture")){let o=r.getAttribute("filename");o!==null&&t[o]===void 0&&(e(o),r.remove())}return iL(n),n}function iL(s){let t=new Map,e=[...s.querySelectorAll("robot > material, visual > material")];for(let n of e){let i=n.getAttribute("name");i&&n.childElementCount>0&&!t.has(i)&&t.set(i,n)}for(let n of e){let i=t.get(n.getAttribute("name")??"");i!==void 0&&n.childElementCount===0&&n.replaceWith(i.cloneNode(!0))}}var zd=class{constructor(t,e,n){this.model=t;this.isShaded=e;this.events=n;this.object=this.load(),this.object.matrixAutoUpdate=!1,this.object.visible=!1,this.listParts(this.object,-1,null);let i=this.parts[0];this.basePart=i.name===Vn&&this.parts[1]||i,this.base=this.basePart.name,this.dress()}model;isShaded;events;object;base;parts=[];basePart;colliders=[];problems=new Set;highlight=new Nd;edges=new Xn({transparent:!0});collider=kv(pc.light.collision);chosen=null;joint(t){return this.object.joints[t]}get movingLinks(){return this.parts.filter(({joint:e})=>e!==null&&e.jointType!=="fixed").map(({name:e,parent:n,joint:i})=>({link:e,parent:this.parts[n].name,joint:i?.name??""}))}setJoints(t,e){for(let n of[!1,!0])t.forEach((i,r)=>{let o=this.object.joints[i];o!==void 0&&Number.isFinite(e[r])&&Kv(o)===n&&o.setJointValue(e[r])})}setLinkPose(t,e){let n=this.parts.find(({name:i})=>i===t)?.joint;n&&e.decompose(n.position,n.quaternion,new F)}linkPoses(){for(let{joint:n,parent:i,pose:r}of this.parts)n!==null&&(n.updateMatrix(),r.multiplyMatrices(this.parts[i].pose,n.matrix));let t=this.basePart.pose.clone().invert(),e=this.parts.filter(({name:n})=>n!==Vn);return new Map(e.map(({name:n,pose:i})=>[n,t.clone().multiply(i)]))}place(t){this.object.visible=t!==null,t!==null&&(this.object.matrix.copy(this.basePart.pose).invert().premultiply(t),this.object.updateMatrixWorld(!0))}bounds(){let t=new fn;return this.object.updateMatrixWorld(!0),this.visuals().forEach(e=>t.expandByObject(e)),t}wheelRadius(t){let e=this.object.joints[t];return e===void 0?0:Yv(e)}linkOf(t){for(let e=t;e!==null;e=e.parent)if(this.object.links[e.name]===e)return e.name;return null}visuals(){return Bd(this.object,!0)}showCollisions(t){this.colliders.forEach(e=>e.visible=t)}choose(t,e){this.chosen=t;let n=t===null?void 0:this.object.links[t];this.highlight.set(n?Bd(n,!1):[],e)}setPalette(t){this.edges.color.set(t.partEdge),this.edges.opacity=t.partEdgeOpacity,this.choose(this.chosen,t.highlight)}dispose(){this.highlight.clear(),this.object.removeFromParent(),Dd(this.object),this.edges.dispose(),this.collider.dispose()}load(){let{meshes:t,urdf:e}=this.model,n=Hv(t),i=new Ov(n);i.packages=o=>`package://${o}`,i.parseCollision=!0,n.onLoad=()=>this.events.changed(),n.onError=o=>this.report(`'${o}' could not be loaded`),i.loadMeshCb=(o,a,l,c)=>{Jv(l),Wv(o,t,n,l).then(h=>{c(h),this.dress(),this.events.changed()},h=>this.report(h.message))};let r=$v(e,t,o=>this.report(`the texture '${o}' was not found`));try{let o=i.parse(r);for(let l of Object.values(o.joints))l.ignoreLimits=!0;return Object.values(o.joints).filter(l=>!Kv(l)).forEach(l=>l.setJointValue(0)),o}catch(o){throw new mc(`the robot '${this.model.robot}' cannot be drawn: ${String(o)}`)}}report(t){this.problems.has(t)||(this.problems.add(t),this.events.problem(t))}listParts(t,e,n){let i=this.parts.push({name:t.name,parent:e,joint:n,pose:new Nt})-1;for(let r of t.children.filter(o=>o.name in this.object.joints)){let o=r.children.find(a=>a.name in this.object.links);o!==void 0&&this.listParts(o,i,r)}}dress(){this.object.traverse(t=>{"isURDFCollider"in t&&!this.colliders.includes(t)&&(t.visible=!1,this.colliders.push(t))});for(let t of this.colliders)t.traverse(e=>e instanceof de&&(e.material=this.collider));for(let t of this.visuals().filter(e=>!e.castShadow))t.castShadow=!0,t.receiveShadow=this.isShaded,jv(t)&&([t.material].flat().forEach(Jv),Bv(t,this.edges))}};function Jv(s){s instanceof qn&&!s.userData.isCorrect&&(s.userData.isCorrect=!0,Uv(s))}function Kv(s){return"mimicJoint"in s}var Vd=class{points;firstChanged=0;coarseCapacity;fineCapacity;fineSpacing;coarseSpacing;coarse=0;fine=0;constructor({coarse:t=4096,fine:e=4096,spacing:n=.02}={}){this.coarseCapacity=t,this.fineCapacity=e,this.fineSpacing=n,this.coarseSpacing=n,this.points=new Float32Array(3*(t+e))}get count(){return this.coarse+this.fine}clear(){this.coarse=this.fine=this.firstChanged=0,this.coarseSpacing=this.fineSpacing}markDrawn(){this.firstChanged=this.count}add(t,e,n){return this.count>0&&this.distanceTo(this.count-1,t,e,n)<this.fineSpacing?!1:(this.fine===this.fineCapacity&&this.ageFinePart(),this.points.set([t,e,n],3*this.count),this.fine++,!0)}ageFinePart(){let t=this.coarse,e=t+(this.fine>>1),n=t+this.fine;for(let i=t;i<e;i++){let[r,o,a]=this.points.subarray(3*i,3*i+3);this.addCoarse(r,o,a)}this.points.copyWithin(3*this.coarse,3*e,3*n),this.firstChanged=Math.min(this.firstChanged,this.coarse),this.fine=n-e}addCoarse(t,e,n){this.coarse>0&&this.distanceTo(this.coarse-1,t,e,n)<this.coarseSpacing||(this.coarse===this.coarseCapacity&&this.thinCoarsePart(),this.points.set([t,e,n],3*this.coarse),this.firstChanged=Math.min(this.firstChanged,this.coarse),this.coarse++)}thinCoarsePart(){let t=this.coarse>>1;for(let e=0;e<t;e++)this.points.copyWithin(3*e,6*e,3*(2*e+1));this.coarse=t,this.coarseSpacing*=2,this.firstChanged=0}distanceTo(t,e,n,i){let[r,o,a]=this.points.subarray(3*t,3*t+3);return Math.hypot(e-r,n-o,i-a)}};var Zv=new F,Qv=new We,sL=new F(1,1,1);function cr(s,t,e){return rh(s,t)?(Zv.fromArray(s,t),Qv.fromArray(s,t+3).normalize(),e.compose(Zv,Qv,sL)):null}var Ua=class{names;parents=new Map;locals=new Map;places=new Map;constructor(t){let e=new Set;t.frames.forEach(({name:n,parent:i},r)=>{e.add(i).add(n),this.parents.set(n,i),this.places.set(n,7*r)}),this.names=e}read(t){for(let[e,n]of this.places)this.locals.set(e,cr(t,n,this.locals.get(e)??new Nt))}has(t){return this.names.has(t)}parentOf(t){return this.parents.get(t)??null}localOf(t){return this.locals.get(t)??null}rootOf(t){let e=t;for(let n=this.parentOf(e);n!==null;n=this.parentOf(e))e=n;return e}inRoot(t){let e=new Nt;for(let n=t;this.parentOf(n)!==null;n=this.parentOf(n)){let i=this.localOf(n);if(i===null)return null;e.premultiply(i)}return e}};var rL=3,oL={coarse:1024,fine:1024,spacing:.04},tb=.004,aL=-800,lL=.5,cL=10,Gd=class{constructor(t,e,n){this.lift=e;this.trail=new Vd(n?oL:{});let{points:i}=this.trail;this.buffer=n?new hn(i,3):new Yi(i,3,1),this.buffer.setUsage(or),this.buffer.onUpload(()=>this.trail.markDrawn()),this.object=this.buffer instanceof hn?uL(this.buffer,t):hL(this.buffer,t),this.object.geometry.boundingSphere=new tn,this.object.frustumCulled=!1,this.object.raycast=()=>{},this.draw()}lift;trail;object;buffer;add(t,e,n){this.trail.add(t,e,n+this.lift)&&this.draw()}clear(){this.trail.clear(),this.draw()}dispose(){this.object.geometry.dispose(),[this.object.material].flat().forEach(t=>t.dispose())}draw(){let{count:t,firstChanged:e}=this.trail,{geometry:n}=this.object;n instanceof ar?n.instanceCount=Math.max(0,t-1):n.setDrawRange(0,t),this.object.visible=t>1,this.buffer.clearUpdateRanges(),this.buffer.addUpdateRange(3*e,3*(t-e)),this.buffer.needsUpdate=!0}};function hL(s,t){let e=new ar;e.setAttribute("instanceStart",new Wn(s,3,0)),e.setAttribute("instanceEnd",new Wn(s,3,3));let n=new Nr({color:new Rt(t).getHex(),linewidth:rL});return n.polygonOffset=!0,n.polygonOffsetUnits=aL,new Ia(e,n)}function uL(s,t){let e=new Ae().setAttribute("position",s);return new Cr(e,new Xn({color:t}))}var Hd=class{object=new Ge;truth;odometry;anchor=null;last=null;constructor(t){this.truth=new Gd(Ym,tb,t),this.odometry=new Gd($m,2*tb,t),this.object.matrixAutoUpdate=!1,this.odometry.object.matrixAutoUpdate=!1,this.object.add(this.truth.object,this.odometry.object)}add(t,e){let n=cr(t.truth,0,new Nt),i=cr(t.odometry,0,new Nt),r=n!==null&&this.hasJumped(t.truth,e);if(r&&this.clear(),n!==null&&i!==null&&this.anchor===null&&(this.odometry.clear(),this.anchor=n.clone().multiply(i.clone().invert()),this.odometry.object.matrix.copy(this.anchor)),n!==null){let[o,a,l]=t.truth;this.truth.add(o,a,l),this.last={x:o,y:a,z:l,time:e}}if(i!==null){let[o,a,l]=t.odometry;this.odometry.add(o,a,l)}return r}get anchorInWorld(){return this.anchor?.clone()??null}get counts(){return[this.truth.trail.count,this.odometry.trail.count]}place(t,e){this.object.visible=e&&t!==null,t!==null&&(this.object.matrix.copy(t),this.object.matrixWorldNeedsUpdate=!0)}clear(){this.truth.clear(),this.odometry.clear(),this.odometry.object.matrix.identity(),this.anchor=this.last=null}dispose(){this.object.removeFromParent(),this.truth.dispose(),this.odometry.dispose()}hasJumped([t,e,n],i){return this.last===null?!1:Math.hypot(t-this.last.x,e-this.last.y,n-this.last.z)>lL+cL*Math.abs(i-this.last.time)}};var Wd=class{id;view;trails;size=0;body=null;state=null;constructor(t,e,n,i){this.id=t.robot,this.view=new zd(t,e,n),this.trails=i?.trails??new Hd(!e),this.measure()}read(t,e,n){this.state=n;let i=this.prefixIn(t);n!==null&&this.view.setJoints(e,n.positions),this.readUnknownJoints(t,i,new Map(e.map((a,l)=>[a,l])));let r=new Map;this.view.linkPoses().forEach((a,l)=>r.set(i+l,a));let o=n&&cr(n.truth,0,new Nt);this.body={base:i+this.view.base,truth:o,links:r}}place(t,e,n){let i=this.body&&t.poseOfBody(this.body);this.view.place(i);let r=this.state&&cr(this.state.odometry,0,new Nt),o=this.trails.anchorInWorld?e:i&&r&&i.clone().multiply(r.invert());this.trails.place(o,n)}measure(){let{x:t,y:e,z:n}=this.view.bounds().getSize(new F);this.size=Number.isFinite(t)?Math.max(t,e,n):0}dispose(){this.view.dispose(),this.trails.dispose()}prefixIn(t){let e=this.id.replace(/^\//,""),n=e&&`${e}/`;return!t.has(n+this.view.base)&&t.has(this.view.base)?"":n}readUnknownJoints(t,e,n){for(let{link:i,parent:r,joint:o}of this.view.movingLinks){let a=this.state?.positions[n.get(o)??-1],l=t.localOf(e+i);!(a!==void 0&&Number.isFinite(a))&&l!==null&&t.parentOf(e+i)===e+r&&this.view.setLinkPose(i,l)}}};var Xd=class{states=[];get length(){return this.states.length}get latest(){return this.states.at(-1)??null}add(t){let{latest:e}=this;e!==null&&(t.time<e.time||t.layout.id!==e.layout.id)&&this.clear(),this.states.push(t),this.states.length>180&&this.states.shift()}clear(){this.states=[]}nearest(t){let{states:e}=this;if(e.length===0||t<e[0].time-1)return this.latest;let n=e.findIndex(({time:r})=>r>=t);if(n<0)return this.latest;let i=Math.max(0,n-1);return t-e[i].time<e[n].time-t&&(n=i),e[n]}isSettled(t){let{latest:e}=this;return e!==null&&e.time>=t&&t>=this.states[0].time-1}};var qd=["#3b4cc0","#2aa7d8","#3ecf74","#f2d13d","#e0452f"],eb=256,nb=null;function ib(){return nb??=Uint8Array.from({length:3*eb},(s,t)=>{let e=(qd.length-1)*Math.floor(t/3)/(eb-1),n=Math.min(Math.floor(e),qd.length-2),i=new Rt(qd[n]).lerp(new Rt(qd[n+1]),e-n);return Math.round(255*i.toArray()[t%3])}),nb}var dL=.985,jd=class{object;positions=new Float32Array(0);colours=new Uint8Array(0);constructor(t){let e=new cs({size:t,sizeAttenuation:!1,vertexColors:!0});e.onBeforeCompile=n=>{n.vertexShader=n.vertexShader.replace("#include <project_vertex>",`#include <project_vertex>
         gl_Position = projectionMatrix * vec4(mvPosition.xyz * ${dL}, 1.0);`)},this.object=new Zs(new Ae,e),this.object.geometry.boundingSphere=new tn,this.object.frustumCulled=!1,this.object.matrixAutoUpdate=!1,this.object.raycast=()=>{}}reserve(t){let{geometry:e}=this.object;if(3*t>this.positions.length){e.dispose();let n=2**Math.ceil(Math.log2(Math.max(64,t)));this.positions=new Float32Array(3*n),this.colours=new Uint8Array(3*n);for(let[i,r]of[["position",this.positions],["color",this.colours]]){let o=new hn(r,3,i==="color");e.setAttribute(i,o.setUsage(or))}}}commit(t){let{geometry:e}=this.object;e.setDrawRange(0,t);for(let n of["position","color"]){let i=e.getAttribute(n);i instanceof hn&&(i.clearUpdateRanges(),i.addUpdateRange(0,3*t),i.needsUpdate=!0)}}dispose(){this.object.removeFromParent(),this.object.geometry.dispose(),this.object.material.dispose()}};var fL={scan:4,cloud:2},Jm=12,rb=20,Km=.015,pL=.15,mL=.5,Yd=class{points=new Ge;marks=new Ge;lines=new lr(2.5);shown=new Map;colours=[];distanceColour=new Rt;contactColour=new Rt;constructor(){this.marks.add(this.lines.object)}get isEmpty(){return this.shown.size===0}setPalette(t){this.colours=t.scans.map(e=>new Rt(e)),this.distanceColour.set(t.distance),this.contactColour.set(t.touch),this.unsettle()}take(t,e){let n=this.shown.get(t.topic);if(n?.info.kind===t.kind){Object.assign(n,{info:t,sample:e,isSettled:!1});return}n?.points?.dispose();let i=this.newPoints(t);this.shown.set(t.topic,{info:t,sample:e,pose:null,isSettled:!1,points:i,count:0})}retain(t){for(let[e,{points:n}]of[...this.shown])t.has(e)||(n?.dispose(),this.shown.delete(e))}unsettle(){this.shown.forEach(t=>{t.isSettled=!1})}expire(t){let e=this.shown.size;for(let[n,{info:i,sample:r}]of[...this.shown])i.kind==="contacts"&&t-r.head.origin.stamp>mL&&this.shown.delete(n);return this.shown.size<e}place(t){this.lines.clear();let e=0;for(let n of this.shown.values()){if(!n.isSettled){let{frame:i,stamp:r}=n.sample.head.origin,{pose:o,isSettled:a}=t(i,n.info.robot,r);n.isSettled=a,n.pose=o,this.drawPoints(n,e)}this.drawMarks(n),e+=1}this.lines.commit()}numbers(){let t=[...this.shown].map(([e,{pose:n,points:i,count:r}])=>{let o=n===null?null:SL(i,r,n);return[e,{points:n===null?0:r,extent:o}]});return Object.fromEntries(t)}newPoints({kind:t}){if(t!=="scan"&&t!=="cloud")return null;let e=new jd(fL[t]);return this.points.add(e.object),e}drawPoints(t,e){let{sample:n,pose:i,points:r}=t;if(r!==null&&(r.object.visible=i!==null,i!==null)){if(r.object.matrix.copy(i),r.object.matrixWorldNeedsUpdate=!0,n.head.type==="scan"){let o=this.colours[e%this.colours.length]??new Rt;t.count=gL(r,n,o)}else n.head.type==="cloud"?t.count=yL(r,n,i):t.count=0;r.commit(t.count)}}drawMarks({sample:t,pose:e}){e!==null&&(t.head.type==="range"?this.drawDistance(t,e):t.head.type==="contacts"&&this.drawContacts(t,e))}drawDistance({head:t,floats:e},n){let i=Math.min(t.max_range??rb,rb),r=e[0]===-1/0?t.min_range??0:e[0],o=Math.min(r,i);if(!(o>=0))return;let a=Math.min(Math.PI,Math.max(0,(t.field_of_view??0)/2)),l=h=>new F(o*Math.cos(h),o*Math.sin(h),0).applyMatrix4(n),c=new F().setFromMatrixPosition(n);for(let h of[-a,a])this.lines.add(c,l(h),this.distanceColour);for(let h=0;h<Jm;h+=1){let u=l(-a+2*a*h/Jm);this.lines.add(u,l(-a+2*a*(h+1)/Jm),this.distanceColour)}}drawContacts({floats:t},e){let n=new F,i=new F;for(let r=0;r+6<=t.length;r+=6){let o=new F().fromArray(t,r).applyMatrix4(e),a=new F().fromArray(t,r+3).transformDirection(e);if(Number.isFinite(o.x+o.y+o.z)){for(let l of[[Km,0,0],[0,Km,0],[0,0,Km]])n.fromArray(l).add(o),i.fromArray(l).negate().add(o),this.lines.add(n,i,this.contactColour);a.lengthSq()>.5&&this.lines.add(o,i.copy(o).addScaledVector(a,pL),this.contactColour)}}}};function gL(s,{head:t,floats:e},n){let{angle_min:i,angle_increment:r}=t,o=t.range_min??0,a=t.range_max??1/0;s.reserve(e.length);let{positions:l,colours:c}=s,[h,u,d]=[n.r,n.g,n.b].map(m=>Math.round(255*m)),f=0;return e.forEach((m,y)=>{if(m>=o&&m<=a&&m<1/0){let p=3*f;l[p]=m*Math.cos(i+y*r),l[p+1]=m*Math.sin(i+y*r),l[p+2]=0,c[p]=h,c[p+1]=u,c[p+2]=d,f+=1}}),f}function yL(s,t,e){let{count:n,positions:i,rgb:r,intensities:o}=qy(t);return s.reserve(n),s.positions.set(i),r!==null?s.colours.set(vL(r)):xL(s.colours,o??_L(i,e)),n}function _L(s,{elements:t}){let e=new Float32Array(s.length/3);for(let n=0;n<e.length;n+=1){let[i,r,o]=[s[3*n],s[3*n+1],s[3*n+2]];e[n]=t[2]*i+t[6]*r+t[10]*o+t[14]}return e}function xL(s,t){let e=1/0,n=-1/0;for(let o of t)e=Math.min(e,o),n=Math.max(n,o);let i=ib(),r=255/Math.max(n-e,1e-6);t.forEach((o,a)=>{let l=3*Math.round((o-e)*r);s.set(i.subarray(l,l+3),3*a)})}function vL(s){return s.map(t=>bL[t])}var bL=Uint8Array.from({length:256},(s,t)=>{let[e]=new Rt().setRGB(t/255,0,0,"srgb").toArray();return Math.round(255*e)});function SL(s,t,e){if(s===null||t===0)return null;let n=new F(1/0,1/0,1/0),i=n.clone().negate();for(let r=0;r<t;r+=1){let o=new F().fromArray(s.positions,3*r).applyMatrix4(e);n.min(o),i.max(o)}return[...n.toArray(),...i.toArray()]}var ML=`
  uniform vec2 middle;
  varying vec2 place;
  varying float depth;
  void main() {
    place = position.xy + middle;
    vec4 seen = modelViewMatrix * vec4(position, 1.0);
    depth = -seen.z;
    gl_Position = projectionMatrix * seen;
  }
`,wL=`
  uniform vec3 base;
  uniform vec3 minor;
  uniform vec3 major;
  uniform vec3 horizon;
  uniform vec2 fog;
  uniform float solid;
  uniform float ruled;
  varying vec2 place;
  varying float depth;

  /*
   * How much of this pixel a grid covers. Place and pixel are in cells; the grid fades away where
   * a cell is less than 1/dense pixels.
   */
  float lines(vec2 at, vec2 pixel, float dense) {
    vec2 away = abs(fract(at - 0.5) - 0.5);
    vec2 fade = clamp(1.333 - pixel / (0.75 * dense), 0.0, 1.0);
    vec2 cover = clamp(1.0 - away / pixel, 0.0, 1.0) * fade;
    return max(cover.x, cover.y);
  }

  void main() {
    float near = clamp((fog.y - depth) / (fog.y - fog.x), 0.0, 1.0);
    vec2 pixel = max(fwidth(place), vec2(1e-6));
    float strong = 0.0;
    float cover = 0.0;
    if (ruled * near > 0.0) {
      strong = lines(0.1 * place, 0.1 * pixel, 0.3);
      cover = max(strong, 0.8 * lines(place, pixel, 0.3));
      if (min(pixel.x, pixel.y) < 0.006) {
        cover = max(cover, 0.32 * lines(10.0 * place, 10.0 * pixel, 0.06));
      }
    }
    vec3 line = mix(minor, major, strong);
    vec3 ground = mix(horizon, mix(base, line, cover), near);
    gl_FragColor = solid > 0.5 ? vec4(ground, 1.0) : vec4(line, cover * near);
    #include <colorspace_fragment>
  }
`,ob=24,$d=class extends de{constructor(e,n){let i=["base","minor","major","horizon"].map(o=>[o,{value:new Rt}]),r=new vi({vertexShader:ML,fragmentShader:wL,polygonOffset:!0,polygonOffsetFactor:1,polygonOffsetUnits:1,uniforms:{...Object.fromEntries(i),middle:{value:new Xt},fog:{value:new Xt},solid:{value:0},ruled:{value:1}}});super(TL(e),r);this.mist=n;this.raycast=()=>{},this.renderOrder=1,this.setSolid(!1)}mist;setSolid(e){this.material.uniforms.solid.value=Number(e),this.material.transparent=!e,this.material.depthWrite=e}showGrid(e){this.material.uniforms.ruled.value=Number(e)}follow(e,n){let{middle:i,fog:r}=this.material.uniforms;this.position.set(e,n,0),i.value.set(e,n),r.value.set(this.mist.near,this.mist.far)}setPalette(e){let{base:n,minor:i,major:r,horizon:o}=this.material.uniforms;n.value.set(e.ground),i.value.set(e.gridMinor),r.value.set(e.gridMajor),o.value.set(e.horizon)}};function TL(s){let t=new hs(2,2,ob,ob),e=t.getAttribute("position"),n=i=>s*Math.sign(i)*Math.abs(i)**4;for(let i=0;i<e.count;i++)e.setXY(i,n(e.getX(i)),n(e.getY(i)));return t}var Jd=400,AL=new Nt,EL=new F(-.9,-.45,1.5),ab={hardware:2048,software:256},CL=24,Kd=class{constructor(t,e){this.isSoftware=e;this.sky=new de(new er(Jd,16,12).rotateX(Math.PI/2),new Ui({vertexColors:!0,side:jn,fog:!1,depthWrite:!1})),this.sky.renderOrder=2,this.sky.visible=!e,this.shadows.receiveShadow=!0,this.shadows.renderOrder=2,this.shadows.raycast=()=>{},this.floor.matrixAutoUpdate=!1,this.floor.add(this.ground,this.shadows),this.shadows.material.polygonOffset=!0,this.shadows.material.polygonOffsetUnits=-20,this.castShadows(e?ab.software:ab.hardware),t.fog=this.fog,t.background=this.horizon,t.add(this.sky,this.floor,this.sun,this.sun.target,this.dome)}isSoftware;floor=new Ge;fog=new Sl(0,10,100);ground=new $d(Jd,this.fog);shadows=new de(new hs(2,2),new Bl({depthWrite:!1}));sky;sun=new fo;dome=new Vl;horizon=new Rt;setGround(t){this.ground.setSolid(t!==null),this.floor.matrix.copy(t??AL),this.floor.matrixWorldNeedsUpdate=!0}showGrid(t){this.ground.showGrid(t)}follow(t,e,n,i){let{x:r,y:o}=e.clone().applyMatrix4(this.floor.matrix.clone().invert());this.fog.near=8+n,this.fog.far=Math.min(38+4*n,.9*Jd),this.ground.follow(r,o),this.sky.position.copy(t);let a=2**Math.ceil(Math.log2(Math.min(Math.max(1.2*n,1),CL))),l=this.isSoftware?Math.min(i,a):a;this.shadows.position.set(r,o,0),this.shadows.scale.setScalar(l),this.aimSun(e,l)}setPalette(t){this.horizon.set(t.horizon),this.fog.color.set(t.horizon),this.ground.setPalette(t),this.shadows.material.opacity=t.shadow,this.sun.intensity=t.sun,this.dome.intensity=t.sky,this.dome.groundColor.set(t.ground).lerp(new Rt("#808080"),.5);let e=[],n=this.sky.geometry.getAttribute("position"),i=new Rt(t.zenith),r=new Rt;for(let o=0;o<n.count;o++){let a=Math.max(0,n.getZ(o)/Jd);r.copy(this.horizon).lerp(i,Math.sqrt(a)).toArray(e,3*o)}this.sky.geometry.setAttribute("color",new $t(e,3))}castShadows(t){this.sun.castShadow=!0,this.sun.shadow.mapSize.set(t,t),this.sun.shadow.bias=-4e-4,this.sun.shadow.normalBias=.01,this.sun.shadow.radius=3}aimSun(t,e){let n=16*e/this.sun.shadow.mapSize.x,i=a=>n*Math.round(a/n);this.sun.target.position.set(i(t.x),i(t.y),i(t.z)),this.sun.position.copy(EL).multiplyScalar(2*e).add(this.sun.target.position);let{camera:r}=this.sun.shadow,o=1.5*e;r.right!==o&&(r.left=r.bottom=-o,r.right=r.top=o,r.near=.1,r.far=6*e,r.updateProjectionMatrix())}};var RL=25,PL=new Set(["box","cylinder","triangles"]),Zd=class{constructor(t){this.isShaded=t;this.object.matrixAutoUpdate=!1,this.object.visible=!1}isShaded;object=new Ge;hasGround=!1;edges=new Xn({transparent:!0});set(t){Dd(this.object),this.object.clear(),this.hasGround=t.shapes.some(lb);for(let e of t.shapes.filter(n=>!lb(n)))this.object.add(this.draw(e))}place(t){this.object.visible=t!==null,t!==null&&(this.object.matrix.copy(t),this.object.matrixWorldNeedsUpdate=!0)}setPalette(t){this.edges.color.set(t.edge),this.edges.opacity=t.edgeOpacity}draw(t){let[e,n,i,r]=t.colour,o=new de(LL(t),new lo({color:new Rt().setRGB(e,n,i,Te),opacity:r,transparent:r<1,depthWrite:r===1,flatShading:t.kind==="triangles"}));return o.name=t.name,o.position.fromArray(t.position),o.quaternion.fromArray(t.orientation),o.castShadow=this.isShaded&&r>.5&&t.kind!=="plane",o.receiveShadow=this.isShaded,PL.has(t.kind)&&o.add(new Bi(new oo(o.geometry,RL),this.edges)),o}};function lb({kind:s,size:t,position:e,orientation:n}){let i=Math.hypot(n[0],n[1])<1e-6;return s==="plane"&&t[0]===0&&i&&Math.abs(e[2])<1e-6}function LL({kind:s,size:[t,e,n],points:i}){switch(s){case"box":return new Ms(t,e,n);case"sphere":return new er(.5,32,20).scale(t,e,n);case"cylinder":return new tr(.5,.5,1,40).rotateX(Math.PI/2).scale(t,e,n);case"capsule":return new Il(t/2,Math.max(0,n-t),10,28).rotateX(Math.PI/2);case"plane":return new hs(t||cb,e||cb);case"triangles":{let r=new Ae;return r.setAttribute("position",new $t(i,3)),r.computeVertexNormals(),r}}}var cb=800;var IL=.28,NL=12,hb={type:"layout",id:-1,frames:[],robots:[]},Qd=class{constructor(t){this.isSoftware=t;this.world=new Zd(!t),this.surroundings=new Kd(this.scene,t),this.scene.add(this.world.object,this.sensors.points),this.overlay.add(this.axes.object,this.contacts.object,this.sensors.marks)}isSoftware;scene=new Tr;overlay=new Tr;world;surroundings;sensors=new Yd;options={frames:!0,frameNames:!0,trails:!0,contacts:!0,collisions:!1,grid:!0};chosenFrame=null;fixedFrame=Vn;placed=[];robots=new Map;placement=new kd;axes=new pd;contacts=new Sd;history=new Xd;layout=hb;tree=new Ua(hb);state=null;drawn=null;isWaiting=!1;setModel(t,e,n){let i=this.robots.get(t.robot),r=new Wd(t,!this.isSoftware,e,i);i?.view.dispose(),this.robots.set(t.robot,r),r.view.setPalette(n),r.view.showCollisions(this.options.collisions),this.scene.add(r.view.object,r.trails.object)}removeRobot(t){this.forgetAnchor(t),this.robots.get(t)?.dispose(),this.robots.delete(t)}setLayout(t){this.layout=t,this.tree=new Ua(t),this.isWaiting=this.drawn!==null,this.state=this.drawn=null}setState(t){if(t.layout.id!==this.layout.id)return!1;this.state=t,this.history.add(t),this.isWaiting=!1;for(let e of t.robots)this.robots.get(e.id)?.trails.add(e,t.time)&&this.forgetAnchor(e.id);return this.sensors.expire(t.time)||Pv(this.drawn,t)}setOptions(t){this.options={...this.options,...t},this.surroundings.showGrid(this.options.grid),this.views().forEach(e=>e.showCollisions(this.options.collisions))}setPalette(t){let{surroundings:e,world:n,axes:i,contacts:r,sensors:o}=this;for(let a of[e,n,i,r,o,...this.views().values()])a.setPalette(t)}setSample(t,e){this.sensors.take(t,e)}measure(t){let e=this.robots.get(t);e!==void 0&&(e.measure(),this.contacts.forget(e.view))}clearTrails(){this.placement.clear(),this.robots.forEach(({trails:t})=>t.clear())}trailSizes(){let t=[...this.robots].map(([e,{trails:n}])=>[e,n.counts]);return Object.fromEntries(t)}views(){return new Map([...this.robots].map(([t,{view:e}])=>[t,e]))}get size(){return Math.max(0,...[...this.robots.values()].map(t=>t.size))||1}frames(){let t=new Set(this.tree.names);for(let{body:e}of this.robots.values())e!==null&&t.add(e.base);return this.hasTruth()?[Vn,...[...t].filter(e=>e!==Vn)]:[...t]}poseOf(t){let e=t===null?null:this.robots.get(t)?.body;return e?this.placement.poseOfBody(e):null}bounds(){let t=new fn;for(let e of this.views().values()){let n=e.object.visible?e.bounds():new fn;(t.isEmpty()||n.distanceToPoint(t.getCenter(new F))<NL)&&t.union(n)}return t}place(){if(this.isWaiting)return;this.readState();let t=this.fixedFrame;this.fixedFrame=this.chosenFrame??this.defaultFrame(),this.fixedFrame!==t&&this.sensors.unsettle();let e=[...this.robots.values()],n=e.flatMap(({body:r})=>r??[]);this.placement.update(this.tree,n,this.fixedFrame);let i=this.placement.poseOf(Vn);this.world.place(i),this.surroundings.setGround(this.world.hasGround?i:null),e.forEach(r=>r.place(this.placement,i,this.options.trails)),this.placeFrames(),this.placeContacts(),this.sensors.place(this.locator())}locator(){let t=new Map;return(e,n,i)=>{let r=this.history.nearest(i);if(r===null)return{pose:null,isSettled:!1};let o=t.get(r)??this.placementAt(r);t.set(r,o);let a=`${n.slice(1)}/${e}`,l=o.poseOf(a)??o.poseOf(e);return{pose:l,isSettled:l!==null&&this.history.isSettled(i)}}}placementAt(t){let e=new Ua(t.layout);e.read(t.poses);let n=[...this.robots.values()].flatMap(({id:i,body:r})=>{let o=t.robots.find(l=>l.id===i)?.truth,a=o===void 0?null:cr(o,0,new Nt);return r===null?[]:[{...r,truth:a,links:new Map([[r.base,new Nt]])}]});return this.placement.at(e,n,this.fixedFrame)}forgetAnchor(t){let e=this.robots.get(t)?.body?.base;e!==void 0&&this.placement.forget(this.tree.rootOf(e))}readState(){let{state:t}=this;t!==null&&this.tree.read(t.poses);for(let e of this.robots.values()){let n=this.layout.robots.findIndex(({id:i})=>i===e.id);e.read(this.tree,this.layout.robots[n]?.joints??[],t?.robots[n]??null)}this.drawn=t}placeFrames(){this.placed=this.frames().flatMap(t=>{let e=this.placement.poseOf(t),n=this.tree.parentOf(t),i=n===null?null:this.placement.poseOf(n);return e===null?[]:{name:t,pose:e,parent:i}}),this.axes.object.visible=this.options.frames,this.axes.draw(this.placed,IL*this.size)}placeContacts(){this.contacts.begin(),this.layout.robots.forEach(({id:t,wheels:e},n)=>{let i=this.robots.get(t)?.view,r=this.state?.robots[n];this.options.contacts&&i?.object.visible&&r&&this.contacts.add(i,e,r)}),this.contacts.commit()}hasTruth(){return this.state?.robots.some(({truth:t})=>rh(t))??!1}defaultFrame(){if(this.hasTruth())return Vn;let t=[...this.robots.values()].find(({body:n})=>n!==null)?.body?.base,[e]=this.tree.names;return t!==void 0?this.tree.rootOf(t):e??Vn}};var Ba=class extends Error{name="NoWebGL";constructor(){super("This browser offers no WebGL 2, so the 3-D view is off; everything else works. Turn on hardware acceleration in its settings, or try another browser.")}};function ub(){let s=document.createElement("canvas").getContext("webgl2");if(s===null)throw new Ba;let t=s.getExtension("WEBGL_debug_renderer_info"),e=String(s.getParameter(t?t.UNMASKED_RENDERER_WEBGL:s.RENDERER));return s.getExtension("WEBGL_lose_context")?.loseContext(),/swiftshader|llvmpipe|softpipe|software|basic render/i.test(e)}var tf=class{onSelect=()=>{};onProblem=()=>{};picture;labels;painter;rig;palette=pc.light;followed=null;picked=null;isStale=!0;framed=null;constructor(t){let e=ub();this.picture=new Qd(e),this.labels=new xd(t),this.painter=new vd(t,e,this.step,this.onResize),this.rig=new _d(t,this.painter.dirty,()=>this.resetView());let n=()=>this.picture.views();new bd(t,this.rig.camera,n,this.onPick),this.setTheme("light"),this.resize()}setModel(t){let e={changed:()=>this.onMesh(t.robot),problem:n=>this.onProblem(n)};try{this.picture.setModel(t,e,this.palette)}catch(n){this.onProblem(n instanceof Error?n.message:String(n))}this.invalidate()}removeRobot(t){this.picture.removeRobot(t),this.followed===t&&this.follow(null),this.picked?.robot===t&&(this.picked=null),this.invalidate()}setWorld(t){this.picture.world.set(t),this.invalidate()}setLayout(t){this.picture.setLayout(t)}applyState(t){this.picture.setState(t)&&this.invalidate()}takeSample(t,e){this.picture.setSample(t,e),this.invalidate()}retainSensors(t){this.picture.sensors.retain(t),this.invalidate()}sensorNumbers(){return this.picture.sensors.numbers()}setFixedFrame(t){this.picture.chosenFrame=t,this.invalidate()}frames(){return this.picture.frames()}show(t){this.picture.setOptions(t),this.invalidate()}shows(t){return this.picture.options[t]}follow(t){this.followed=t,this.rig.stopFollowing(),t!==null&&this.resetView()}resetView(){let t=this.picture.poseOf(this.followed),e=this.picture.views().get(this.followed??"");t!==null&&e!==void 0?this.rig.startFollowing(t,e.bounds()):this.rig.frame(this.picture.bounds()),this.painter.dirty()}select(t,e){this.picked={robot:t,link:e};for(let[n,i]of this.picture.views())i.choose(n===t?e:null,this.palette.highlight);this.invalidate()}clearTrails(){this.picture.clearTrails(),this.invalidate()}setTheme(t){this.palette=pc[t],this.picture.setPalette(this.palette),this.invalidate()}resize(){this.painter.resize()}stats(){return{frames:this.painter.frames,triangles:this.painter.triangles}}extent(){let{min:t,max:e}=this.picture.bounds();return[...t.toArray(),...e.toArray()]}trailSizes(){return this.picture.trailSizes()}invalidate(){this.isStale=!0,this.painter.dirty()}onResize=(t,e,n)=>{this.rig.resize(t/Math.max(1,e)),this.labels.resize(n)};onMesh(t){this.picture.measure(t),this.rig.isMoved||(this.framed=null),this.invalidate()}onPick=t=>{let{robot:e,link:n}=t??{robot:this.picked?.robot??"",link:null};e!==""&&(this.select(e,n),this.onSelect(e,n))};step=t=>{let{picture:e,rig:n}=this;this.isStale&&(this.isStale=!1,e.place(),this.pointCamera());let i=n.update(t,e.poseOf(this.followed));e.surroundings.follow(n.camera.position,n.target,n.distance,e.size),this.painter.paint(e.scene,e.overlay,n.camera);let{frames:r,frameNames:o}=e.options,a=r&&o?mv(e.placed,e.fixedFrame):[];return this.labels.draw(a,n.camera,this.palette),i};pointCamera(){[...this.picture.views().values()].some(({object:e})=>e.visible)&&this.framed!==this.picture.fixedFrame&&(this.framed=this.picture.fixedFrame,this.resetView())}};var DL=[{name:"frames",label:"Frames",on:!1,title:"Axes of the TF frames"},{name:"frameNames",label:"Names",on:!1,title:"Names of the frames"},{name:"trails",label:"Trails",on:!0,title:"Where the robot went: truth and odometry"},{name:"contacts",label:"Contacts",on:!1,title:"Load and slip of the wheels"},{name:"collisions",label:"Collisions",on:!1,title:"Shapes that touch"},{name:"grid",label:"Grid",on:!0,title:"Squares of 1 m"}],ef=class{constructor(t,e){this.app=t;this.sensing=e;this.element=B("main",{class:"view",id:"view"},this.canvas,this.words,this.hint),this.scene=this.makeScene(),this.scene===null?this.canvas.remove():(this.element.append(this.tools(this.scene),UL(t)),this.connect(this.scene)),t.store.watch(["graph","link","robot"],()=>this.showWords())}app;sensing;element;scene;whyBlind="";canvas=B("canvas",{class:"scene","aria-label":"The robot in its world"});words=B("div",{class:"view-words"});hint=B("div",{class:"view-hint",hidden:!0});following=Ri("follow")!=="no";get watches(){return this.scene?.shows("contacts")===!0?["wheels"]:[]}get topics(){return this.scene===null?[]:this.sensing.inScene.map(({topic:t})=>t)}applySample(t){let e=this.sensing.take(t);e!==null&&e.kind!=="picture"&&this.scene?.takeSample(e,t)}apply(t){this.scene?.applyState(t)}setTheme(t){this.scene?.setTheme(t)}makeScene(){try{return new tf(this.canvas)}catch(t){if(t instanceof Ba)return this.whyBlind=t.message,document.body.classList.add("blind"),null;throw t}}connect(t){let{store:e}=this.app,n=new Set;e.watch(["model","graph"],()=>{for(let i of[...n].filter(r=>!e.models.has(r)))t.removeRobot(i),n.delete(i)}),e.watch(["layout"],()=>{e.layout!==null&&t.setLayout(e.layout)}),e.watch(["frame"],()=>t.setFixedFrame(e.fixedFrame)),e.watch(["reset"],()=>t.clearTrails()),this.sensing.onChange=()=>t.retainSensors(new Set(this.sensing.latest.keys())),e.watch(["robot","graph"],()=>this.follow(t)),e.onModel=i=>{t.setModel(i),n.add(i.robot)},e.onWorld=i=>t.setWorld(i),e.watch(["graph"],()=>{e.worlds.size===0&&t.setWorld({type:"world",simulator:"",shapes:[]})}),t.onProblem=i=>e.note("warning",i),t.onSelect=(i,r)=>{e.choose(i),e.select({robot:i,frame:r})},new ResizeObserver(()=>t.resize()).observe(this.canvas)}follow(t){t.follow(this.following?this.app.store.robot?.id??null:null)}tools(t){let e=ja("Follow",this.following,i=>{this.following=i,ui("follow",i?"yes":"no"),this.follow(t)},"The camera goes with the robot"),n=DL.map(({name:i,label:r,on:o,title:a})=>{let l=Ri(`show.${i}`),c=l===null?o:l==="yes";return t.show({[i]:c}),ja(r,c,u=>{ui(`show.${i}`,u?"yes":"no"),t.show({[i]:u})},a)});return B("div",{class:"view-tools",role:"toolbar","aria-label":"View"},$e("Reset view",()=>t.resetView(),{kind:"quiet"}),e,B("span",{class:"rule","aria-hidden":"true"}),...n,$e("Clear trails",()=>t.clearTrails(),{kind:"quiet"}))}showWords(){let{link:t,graph:e,robot:n}=this.app.store,i=t.state!=="open",r=!i&&e!==null&&e.robots.length===0;this.hint.hidden=i||n===null||n.command===null,this.hint.replaceChildren("Hold ",...OL()," or the arrow keys to drive"),this.words.replaceChildren(),i?this.sayLost(t):r?this.say("Nothing to see yet",e.hint??"Nobody publishes a robot description."):this.scene===null&&this.say("No 3-D view",this.whyBlind)}sayLost(t){if(t.state==="waiting"){let n=`${t.reason===""?"The viewer does not answer.":`${t.reason}.`} This page connects again by itself as soon as it does.`;this.say("No connection",n)}else this.say("Connecting \u2026","")}say(t,e){let n=B("h2",{});he(n,t);let i=e.charAt(0).toUpperCase()+e.slice(1);this.words.append(B("div",{class:"card"},n,B("p",{},...FL(i))))}};function OL(){return["W","A","S","D"].map(s=>B("kbd",{},s))}function FL(s){return s.split("`").map((t,e)=>e%2===1?B("code",{},t):document.createTextNode(t))}function UL({store:s}){let t=(r,o)=>B("span",{},B("i",{class:`swatch ${r}`}),o),e=t("truth","Truth"),n=t("odometry","Odometry"),i=B("div",{class:"view-legend","aria-hidden":"true"},e,n);return s.watch(["graph","robot"],()=>{e.hidden=(s.robot?.truth??null)===null,n.hidden=(s.robot?.odometry??null)===null,i.hidden=e.hidden&&n.hidden}),i}var db="[[],[]]",nf=class{constructor(t,e=()=>!0){this.send=t;this.isSeen=e}send;isSeen;told=db;forget(){this.told=db}show(t,e=[]){let n=this.isSeen()?fb(t):[],i=this.isSeen()?fb(e):[],r=JSON.stringify([n,i]);r!==this.told&&this.send({type:"watch",parts:n,topics:i})&&(this.told=r)}};function fb(s){return[...new Set(s)].sort()}var BL=100,Kn=new ch,Mo=new bc(Mg(window.location)),Ur=new Pc({send:s=>Mo.send(s),now:()=>performance.now(),after:(s,t)=>{let e=setTimeout(t,s);return()=>clearTimeout(e)}}),zi={store:Kn,connection:Mo,pilot:Ur},gc=new ih(s=>Kn.turningJoints(s)),sf=new lh(Kn),pb=new nf(s=>Mo.send(s),()=>document.visibilityState==="visible"),mb=new ah(Kn),Fr=new ef(zi,mb),Zm=new Rc(zi),gb=new sh(zi,gc),yb=new Uc(zi),_b=new Dc(zi),xb=new kc(zi,mb),So=new hh("tab");for(let s of[yb,new Oc(zi),xb,new Nc(zi,()=>Fr.scene?.frames()??[]),new zc(zi),new Ic(zi),_b])So.add(s);var vb=jy(zi,{view:Fr,drive:Zm,plots:gb,tabs:So}),kL=Py(s=>{Fr.setTheme(s),gb.repaint()}),bb=new Lc(zi,{flipTheme:kL.flip,openPanels:vb.openPanels}),zL=B("a",{class:"skip",href:"#drive"},"Skip to driving");document.body.prepend(zL,bb.element);document.body.append(vg(Kn));Kn.watch(["graph","robot","model","diagnostics"],()=>{So.setBadge("model",yb.toLookAt,"warning"),So.setBadge("health",_b.toLookAt,"warning")});Kn.watch(["graph"],()=>gc.keep((Kn.graph?.robots??[]).map(({id:s})=>s)));Kn.watch(["reset"],()=>gc.clear());Kn.watch(["driver","robot","graph"],()=>{let{driver:s}=Kn;Ur.setTaken(s!==null&&!s.me)});Ur.onRefused=()=>{Kn.note("warning",`${Kn.driver?.name} drives; STOP stops it for everybody.`)};Dg(Ur);Ng(Ur,s=>Zm.showPad(s));Mo.onLink=s=>{s.state!=="open"&&(Ur.halt(),pb.forget()),Kn.setLink(s)};Mo.onMessage=s=>{s.type==="driver"&&s.stopped!==null&&s.stopped===Kn.client&&Ur.halt(),Kn.take(s)};Mo.onBinary=s=>{if(Wy(s)){let e=sf.takeSample(s);e!==null&&Fr.applySample(e);return}Ur.keepUp();let t=sf.take(s);t!==null&&(Fr.apply(t),gc.record(t,Kn.simulation?.real_factor??null))};function Sb(){pb.show([...So.watches,...Fr.watches],[...So.topics,...Fr.topics])}document.addEventListener("visibilitychange",Sb);setInterval(()=>{Sb();let s=sf.fresh();if(s!==null)for(let t of[bb,Zm,So,vb])t.pulse(s)},BL);Hg({app:zi,stream:sf,recorder:gc,view:Fr,sensors:xb});Mo.open();
